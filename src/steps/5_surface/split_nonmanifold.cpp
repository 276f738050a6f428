#include "steps/5_surface/split_nonmanifold.h"

#include "base/parallel.h"
#include "geometry/predicates.h"
#include "mesh/fans.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <tuple>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// A soup and, for every side, the side it is sewn to, or kNoSide at a border. Sewn sides run along
/// the same two vertices in opposite directions.
struct SewnSoup {
    TriMesh mesh;
    std::vector<Side> mates;

    void sew(Side a, Side b)
    {
        mates[a] = b;
        mates[b] = a;
    }
};

/// Orders faces by their angle around the edge u v, counter-clockwise seen from v, beginning at a
/// face with the apex `reference`. Exact, however thin the wedges.
class AngleAroundEdge {
  public:
    AngleAroundEdge(const Vector3d& u, const Vector3d& v, const Vector3d& reference)
        : u_(u), v_(v), reference_(reference)
    {
    }

    /// Whether apex a comes before apex b.
    bool less(const Vector3d& a, const Vector3d& b) const
    {
        const int quarter_a = quarter(a);
        const int quarter_b = quarter(b);
        if (quarter_a != quarter_b) return quarter_a < quarter_b;
        return quarter_a % 2 == 1 && orientation(u_, v_, a, b) > 0;
    }

  private:
    /// 0 at the reference, 1 less than half a turn on, 2 just half a turn, 3 more.
    int quarter(const Vector3d& apex) const
    {
        const int side = orientation(u_, v_, reference_, apex);
        if (side != 0) return side > 0 ? 1 : 3;
        const Vector3d axis = v_ - u_;
        return axis.cross(apex - u_).dot(axis.cross(reference_ - u_)) < 0.0 ? 2 : 0;
    }

    const Vector3d& u_;
    const Vector3d& v_;
    const Vector3d& reference_;
};

/// The sides of one edge in the order of their faces around it, seen along lower -> higher vertex.
std::vector<Side> sorted_by_angle(const TriMesh& mesh, std::span<const Side> sides)
{
    const auto [lower, higher] =
        std::minmax({tail(mesh.faces, sides[0]), head(mesh.faces, sides[0])});
    const Vector3d& u = mesh.positions[lower];
    const Vector3d& v = mesh.positions[higher];
    const auto apex = [&](Side side) -> const Vector3d& {
        return mesh.positions[tail(mesh.faces, previous_side(side))];
    };

    std::vector<Side> sorted(sides.begin(), sides.end());
    const auto reference =
        std::ranges::find_if(sides, [&](Side side) { return !collinear(u, v, apex(side)); });
    if (reference == sides.end()) return sorted; // no face spans an angle
    const AngleAroundEdge angle(u, v, apex(*reference));
    std::ranges::stable_sort(sorted, [&](Side a, Side b) { return angle.less(apex(a), apex(b)); });
    return sorted;
}

/// Sews the faces of an edge in pairs that bound one solid sector each. Going round, a face that
/// runs against lower -> higher opens a sector and one that runs along closes it; they nest like
/// brackets where faces of sectors in between are missing.
void sew_sectors(std::span<const Side> sides, SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const auto opens = [&](Side side) { return tail(faces, side) > head(faces, side); };
    const std::vector<Side> around = sorted_by_angle(soup.mesh, sides);
    std::vector<Side> open;
    // The second turn closes what the first left open at its end.
    for (std::size_t i = 0; i < 2 * around.size(); ++i) {
        const Side side = around[i % around.size()];
        const bool first_turn = i < around.size();
        if (opens(side) && first_turn) {
            open.push_back(side);
        } else if (!opens(side) && soup.mates[side] == kNoSide && !open.empty()) {
            soup.sew(open.back(), side);
            open.pop_back();
        }
    }
}

/// What sew_edges leaves for later.
struct Crowd {
    std::int64_t num_edges = 0;       ///< edges with more than two faces
    std::vector<std::uint32_t> faces; ///< at edges that are more than one border or one seam
};

Crowd sew_edges(SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const EdgeTable edges = gather_edges(faces, soup.mesh.positions.size());
    const auto crowded =
        parallel_collect<std::uint32_t>(edges.size(), [&](std::size_t e, auto& found) {
            const std::span<const Side> sides = edges[e];
            if (sides.size() == 2 && tail(faces, sides[0]) != tail(faces, sides[1])) {
                soup.sew(sides[0], sides[1]);
            } else if (sides.size() > 1) {
                found.push_back(static_cast<std::uint32_t>(e));
            }
        });

    Crowd crowd;
    for (const std::uint32_t e : crowded) {
        if (edges[e].size() > 2) {
            ++crowd.num_edges;
            sew_sectors(edges[e], soup);
        }
        for (const Side side : edges[e]) {
            crowd.faces.push_back(side / 3);
        }
    }
    return crowd;
}

/// Adds a vertex with the attributes of `original`.
std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original)
{
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Vector3d(mesh.positions[original]));
    if (!mesh.colors.empty()) mesh.colors.push_back(Color(mesh.colors[original]));
    if (!mesh.points.empty()) mesh.points.push_back(std::uint32_t(mesh.points[original]));
    return copy;
}

/// The corners of vertices whose corners do not all hang together through seams, ascending.
std::vector<Side> corners_to_separate(const SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const std::vector<Side> starts = corners_of_vertices(faces, soup.mesh.positions.size());
    std::vector<char> reached(3 * faces.size(), 0);
    parallel_for(starts.size(), [&](std::size_t v) {
        for_each_corner_of_fan(soup.mates, starts[v], [&](Side corner) { reached[corner] = 1; });
    });
    std::vector<char> separate(starts.size(), 0);
    for (std::size_t corner = 0; corner < reached.size(); ++corner) {
        if (reached[corner] == 0) separate[tail(faces, static_cast<Side>(corner))] = 1;
    }
    return parallel_collect<Side>(faces.size(), [&](std::size_t face, auto& found) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (separate[faces[face][i]] != 0) found.push_back(static_cast<Side>(3 * face + i));
        }
    });
}

/// Gives each fan of corners that hang together through seams a vertex of its own; the fan of the
/// first corner keeps the old one. Returns how many vertices came apart.
std::int64_t separate_vertices(SewnSoup& soup)
{
    std::vector<Face>& faces = soup.mesh.faces;
    std::set<std::uint32_t> split; // few
    std::set<Side> done;
    for (const Side corner : corners_to_separate(soup)) {
        if (done.contains(corner)) continue;
        const std::uint32_t original = tail(faces, corner);
        const bool keeps = split.insert(original).second;
        const std::uint32_t vertex = keeps ? original : add_copy(soup.mesh, original);
        for_each_corner_of_fan(soup.mates, corner, [&](Side other) {
            done.insert(other);
            faces[other / 3][other % 3] = vertex;
        });
    }
    return static_cast<std::int64_t>(split.size());
}

std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t middle = add_copy(mesh, a);
    mesh.positions[middle] = mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) / 2;
    for (std::size_t i = 0; i < 3 && !mesh.colors.empty(); ++i) {
        mesh.colors[middle][i] =
            static_cast<std::uint8_t>((mesh.colors[a][i] + mesh.colors[b][i] + 1) / 2);
    }
    if (!mesh.points.empty()) mesh.points[middle] = kNoPoint;
    return middle;
}

/// Splits a face a b c at `middle`, a point of its side a b, into a middle c, which keeps number
/// and sides, and middle b c. Returns the side middle -> b; that one and a -> middle are left to be
/// sewn.
Side split_face(SewnSoup& soup, Side side, std::uint32_t middle)
{
    std::vector<Face>& faces = soup.mesh.faces;
    const Side far = next_side(side); // was b -> c, becomes middle -> c
    const Side added = static_cast<Side>(3 * faces.size());
    faces.push_back({middle, head(faces, side), head(faces, far)});
    faces[far / 3][far % 3] = middle;

    soup.mates.resize(3 * faces.size(), kNoSide);
    if (soup.mates[far] != kNoSide) soup.sew(added + 1, soup.mates[far]);
    soup.sew(far, added + 2);
    soup.mates[side] = kNoSide;
    return added;
}

/// One border or one seam of an edge gets a vertex of its own in the middle.
void split_seam(SewnSoup& soup, Side side)
{
    const Side mate = soup.mates[side];
    const std::uint32_t middle =
        add_midpoint(soup.mesh, tail(soup.mesh.faces, side), head(soup.mesh.faces, side));
    const Side added = split_face(soup, side, middle);
    if (mate == kNoSide) return;
    const Side added_to_mate = split_face(soup, mate, middle);
    soup.sew(side, added_to_mate);
    soup.sew(mate, added);
}

/// The sides of some faces that share their two ends with others of these, edge by edge.
std::vector<std::vector<Side>> shared_edges(const SewnSoup& soup,
                                            const std::set<std::uint32_t>& some_faces)
{
    std::vector<std::tuple<std::uint32_t, std::uint32_t, Side>> sides;
    for (const std::uint32_t face : some_faces) {
        for (Side side = 3 * face; side < 3 * face + 3; ++side) {
            const auto ends =
                std::minmax({tail(soup.mesh.faces, side), head(soup.mesh.faces, side)});
            sides.emplace_back(ends.first, ends.second, side);
        }
    }
    std::ranges::sort(sides);
    std::vector<std::vector<Side>> edges;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto [lower, higher, side] = sides[i];
        const bool begins =
            i == 0 || std::get<0>(sides[i - 1]) != lower || std::get<1>(sides[i - 1]) != higher;
        if (begins) edges.emplace_back();
        edges.back().push_back(side);
    }
    return edges;
}

/// One round of separate_seams over the edges of `crowd`. A face takes part in one split at most,
/// because splitting renumbers its sides. Returns the faces to look at again.
std::set<std::uint32_t> separate_seams_once(SewnSoup& soup, const std::set<std::uint32_t>& crowd)
{
    std::set<std::uint32_t> touched;
    std::set<std::uint32_t> again;
    for (const std::vector<Side>& sides : shared_edges(soup, crowd)) {
        const Side first_mate = soup.mates[sides[0]];
        const bool sound = sides.size() == 1 || (sides.size() == 2 && first_mate == sides[1]);
        if (sound) continue;
        for (const Side side : sides) {
            again.insert(side / 3);
            const Side mate = soup.mates[side];
            // The first seam stays as it is; the others are met at their lower side.
            const bool stays = side == sides[0] || side == first_mate || mate < side;
            const bool free =
                !touched.contains(side / 3) && (mate == kNoSide || !touched.contains(mate / 3));
            if (stays || !free) continue;
            touched.insert(side / 3);
            if (mate != kNoSide) touched.insert(mate / 3);
            const auto num_before = static_cast<std::uint32_t>(soup.mesh.faces.size());
            split_seam(soup, side);
            for (std::uint32_t f = num_before; f < soup.mesh.faces.size(); ++f) {
                again.insert(f);
                touched.insert(f);
            }
        }
    }
    return again;
}

/// Splits borders and seams until no two of them run between the same two vertices. All that can
/// are among the faces of `crowd`.
void separate_seams(SewnSoup& soup, const std::vector<std::uint32_t>& crowd)
{
    std::set<std::uint32_t> faces(crowd.begin(), crowd.end());
    while (!faces.empty()) {
        faces = separate_seams_once(soup, faces);
    }
}

} // namespace

ManifoldSurface split_nonmanifold(TriMesh mesh)
{
    SewnSoup soup{.mesh = std::move(mesh), .mates = {}};
    soup.mesh.normals.clear();
    std::erase_if(soup.mesh.faces, is_degenerate);
    soup.mates.resize(3 * soup.mesh.faces.size(), kNoSide);

    const Crowd crowd = sew_edges(soup);
    const std::int64_t split_vertices = separate_vertices(soup);
    separate_seams(soup, crowd.faces);
    return {std::move(soup.mesh), std::move(soup.mates), crowd.num_edges, split_vertices};
}

} // namespace vcarve
