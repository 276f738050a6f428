#include "steps/6_surface/split_nonmanifold.h"

#include "base/parallel.h"
#include "geometry/predicates.h"
#include "mesh/edge_table.h"
#include "mesh/vertices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <tuple>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// A soup, and the twin of each half-edge, or kNoHalfEdge at a boundary. Twins run along the same
/// two vertices in opposite directions.
struct SewnSoup {
    TriMesh mesh;
    std::vector<HalfEdge> twins;

    void sew(HalfEdge a, HalfEdge b)
    {
        twins[a] = b;
        twins[b] = a;
    }
};

/// Orders faces by their angle around the edge u v, counter-clockwise seen from v, starting at a
/// face with the apex `reference`. Exact, even for thin wedges.
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
    /// 0 at the reference, 1 below half a turn, 2 at exactly half a turn, 3 above.
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

/// The half-edges of one edge, sorted by the angle of their faces around it, seen along lower ->
/// higher vertex.
std::vector<HalfEdge> sorted_by_angle(const TriMesh& mesh, std::span<const HalfEdge> half_edges)
{
    const auto [lower, higher] =
        std::minmax({tail(mesh.faces, half_edges[0]), head(mesh.faces, half_edges[0])});
    const Vector3d& u = mesh.positions[lower];
    const Vector3d& v = mesh.positions[higher];
    const auto apex = [&](HalfEdge half_edge) -> const Vector3d& {
        return mesh.positions[tail(mesh.faces, previous_half_edge(half_edge))];
    };

    std::vector<HalfEdge> sorted(half_edges.begin(), half_edges.end());
    const auto reference = std::ranges::find_if(
        half_edges, [&](HalfEdge half_edge) { return !collinear(u, v, apex(half_edge)); });
    if (reference == half_edges.end()) return sorted; // no face spans an angle
    const AngleAroundEdge angle(u, v, apex(*reference));
    std::ranges::stable_sort(sorted,
                             [&](HalfEdge a, HalfEdge b) { return angle.less(apex(a), apex(b)); });
    return sorted;
}

/// Joins the faces of an edge in pairs that bound one solid sector each. In angular order, a
/// half-edge against lower -> higher opens a sector and one along it closes a sector. If faces in
/// between are missing, sectors nest like brackets.
void sew_sectors(std::span<const HalfEdge> half_edges, SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const auto opens = [&](HalfEdge half_edge) {
        return tail(faces, half_edge) > head(faces, half_edge);
    };
    const std::vector<HalfEdge> around = sorted_by_angle(soup.mesh, half_edges);
    std::vector<HalfEdge> open;
    // The second turn closes the sectors that are open at the end of the first.
    for (std::size_t i = 0; i < 2 * around.size(); ++i) {
        const HalfEdge half_edge = around[i % around.size()];
        const bool first_turn = i < around.size();
        if (opens(half_edge) && first_turn) {
            open.push_back(half_edge);
        } else if (!opens(half_edge) && soup.twins[half_edge] == kNoHalfEdge && !open.empty()) {
            soup.sew(open.back(), half_edge);
            open.pop_back();
        }
    }
}

/// The edges that sew_edges() cannot resolve.
struct Crowd {
    std::int64_t num_edges = 0;       ///< edges with more than two faces
    std::vector<std::uint32_t> faces; ///< at edges with more than one boundary half-edge or seam
};

Crowd sew_edges(SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const EdgeTable edges = gather_edges(faces, soup.mesh.positions.size());
    const auto crowded = parallel_collect<std::uint32_t>(edges.size(), [&](std::size_t e,
                                                                           auto& found) {
        const std::span<const HalfEdge> half_edges = edges[e];
        if (half_edges.size() == 2 && tail(faces, half_edges[0]) != tail(faces, half_edges[1])) {
            soup.sew(half_edges[0], half_edges[1]);
        } else if (half_edges.size() > 1) {
            found.push_back(static_cast<std::uint32_t>(e));
        }
    });

    Crowd crowd;
    for (const std::uint32_t e : crowded) {
        if (edges[e].size() > 2) {
            ++crowd.num_edges;
            sew_sectors(edges[e], soup);
        }
        for (const HalfEdge half_edge : edges[e]) {
            crowd.faces.push_back(half_edge / 3);
        }
    }
    return crowd;
}

/// The corners of vertices whose corners are not all connected through seams, ascending.
std::vector<HalfEdge> corners_to_separate(const SewnSoup& soup)
{
    const std::span<const Face> faces(soup.mesh.faces);
    const std::vector<HalfEdge> starts = corners_of_vertices(faces, soup.mesh.positions.size());
    std::vector<char> reached(3 * faces.size(), 0);
    parallel_for(starts.size(), [&](std::size_t v) {
        for_each_corner_of_fan(soup.twins, starts[v],
                               [&](HalfEdge corner) { reached[corner] = 1; });
    });
    std::vector<char> separate(starts.size(), 0);
    for (std::size_t corner = 0; corner < reached.size(); ++corner) {
        if (reached[corner] == 0) separate[tail(faces, static_cast<HalfEdge>(corner))] = 1;
    }
    return parallel_collect<HalfEdge>(faces.size(), [&](std::size_t face, auto& found) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (separate[faces[face][i]] != 0) found.push_back(static_cast<HalfEdge>(3 * face + i));
        }
    });
}

/// Assigns a separate vertex to each fan of corners connected through seams. The fan of the first
/// corner keeps the old vertex. Returns the number of split vertices.
std::int64_t separate_vertices(SewnSoup& soup)
{
    std::vector<Face>& faces = soup.mesh.faces;
    std::set<std::uint32_t> split; // few
    std::set<HalfEdge> done;
    for (const HalfEdge corner : corners_to_separate(soup)) {
        if (done.contains(corner)) continue;
        const std::uint32_t original = tail(faces, corner);
        const bool keeps = split.insert(original).second;
        const std::uint32_t vertex = keeps ? original : add_copy(soup.mesh, original);
        for_each_corner_of_fan(soup.twins, corner, [&](HalfEdge other) {
            done.insert(other);
            faces[other / 3][other % 3] = vertex;
        });
    }
    return static_cast<std::int64_t>(split.size());
}

/// Splits a face a b c at `middle`, a vertex on its half-edge a -> b, into a middle c, which keeps
/// the indices, and middle b c. Returns the half-edge middle -> b. The caller must set the twins of
/// this one and of a -> middle.
HalfEdge split_face(SewnSoup& soup, HalfEdge half_edge, std::uint32_t middle)
{
    std::vector<Face>& faces = soup.mesh.faces;
    const HalfEdge far = next_half_edge(half_edge); // was b -> c, becomes middle -> c
    const HalfEdge added = static_cast<HalfEdge>(3 * faces.size());
    faces.push_back({middle, head(faces, half_edge), head(faces, far)});
    faces[far / 3][far % 3] = middle;

    soup.twins.resize(3 * faces.size(), kNoHalfEdge);
    if (soup.twins[far] != kNoHalfEdge) soup.sew(added + 1, soup.twins[far]);
    soup.sew(far, added + 2);
    soup.twins[half_edge] = kNoHalfEdge;
    return added;
}

/// Splits one boundary half-edge or seam of an edge at a new midpoint.
void split_seam(SewnSoup& soup, HalfEdge half_edge)
{
    const HalfEdge twin = soup.twins[half_edge];
    const std::uint32_t middle =
        add_midpoint(soup.mesh, tail(soup.mesh.faces, half_edge), head(soup.mesh.faces, half_edge));
    const HalfEdge added = split_face(soup, half_edge, middle);
    if (twin == kNoHalfEdge) return;
    const HalfEdge added_to_twin = split_face(soup, twin, middle);
    soup.sew(half_edge, added_to_twin);
    soup.sew(twin, added);
}

/// The half-edges of some faces, grouped by their two vertices.
std::vector<std::vector<HalfEdge>> shared_edges(const SewnSoup& soup,
                                                const std::set<std::uint32_t>& some_faces)
{
    std::vector<std::tuple<std::uint32_t, std::uint32_t, HalfEdge>> half_edges;
    for (const std::uint32_t face : some_faces) {
        for (HalfEdge half_edge = 3 * face; half_edge < 3 * face + 3; ++half_edge) {
            const auto ends =
                std::minmax({tail(soup.mesh.faces, half_edge), head(soup.mesh.faces, half_edge)});
            half_edges.emplace_back(ends.first, ends.second, half_edge);
        }
    }
    std::ranges::sort(half_edges);
    std::vector<std::vector<HalfEdge>> edges;
    for (std::size_t i = 0; i < half_edges.size(); ++i) {
        const auto [lower, higher, half_edge] = half_edges[i];
        const bool begins = i == 0 || std::get<0>(half_edges[i - 1]) != lower ||
                            std::get<1>(half_edges[i - 1]) != higher;
        if (begins) edges.emplace_back();
        edges.back().push_back(half_edge);
    }
    return edges;
}

/// One round of separate_seams over the edges of `crowd`. Splits each face at most once, because
/// this renumbers its half-edges. Returns the faces to process again.
std::set<std::uint32_t> separate_seams_once(SewnSoup& soup, const std::set<std::uint32_t>& crowd)
{
    std::set<std::uint32_t> touched;
    std::set<std::uint32_t> again;
    for (const std::vector<HalfEdge>& half_edges : shared_edges(soup, crowd)) {
        const HalfEdge first_twin = soup.twins[half_edges[0]];
        const bool sound =
            half_edges.size() == 1 || (half_edges.size() == 2 && first_twin == half_edges[1]);
        if (sound) continue;
        for (const HalfEdge half_edge : half_edges) {
            again.insert(half_edge / 3);
            const HalfEdge twin = soup.twins[half_edge];
            // Keeps the first seam, and splits the others at their lower half-edge.
            const bool stays =
                half_edge == half_edges[0] || half_edge == first_twin || twin < half_edge;
            const bool free = !touched.contains(half_edge / 3) &&
                              (twin == kNoHalfEdge || !touched.contains(twin / 3));
            if (stays || !free) continue;
            touched.insert(half_edge / 3);
            if (twin != kNoHalfEdge) touched.insert(twin / 3);
            const auto num_before = static_cast<std::uint32_t>(soup.mesh.faces.size());
            split_seam(soup, half_edge);
            for (std::uint32_t f = num_before; f < soup.mesh.faces.size(); ++f) {
                again.insert(f);
                touched.insert(f);
            }
        }
    }
    return again;
}

/// Splits boundary half-edges and seams until no two join the same vertices. All candidates are at
/// the faces of `crowd`.
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
    SewnSoup soup{.mesh = std::move(mesh), .twins = {}};
    soup.mesh.normals.clear();
    std::erase_if(soup.mesh.faces, is_degenerate);
    soup.twins.resize(3 * soup.mesh.faces.size(), kNoHalfEdge);

    const Crowd crowd = sew_edges(soup);
    const std::int64_t split_vertices = separate_vertices(soup);
    separate_seams(soup, crowd.faces);
    return {std::move(soup.mesh), std::move(soup.twins), crowd.num_edges, split_vertices};
}

} // namespace vcarve
