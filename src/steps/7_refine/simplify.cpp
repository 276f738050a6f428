#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "steps/7_refine/refine.h"

#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using OpenMesh::Geometry::Quadricd;

using Triangle = std::array<Vector3d, 3>;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The quadric of the plane through `place` with a unit normal.
Quadricd plane(const Vector3d& normal, const Vector3d& place, double weight)
{
    Quadricd quadric(normal.x(), normal.y(), normal.z(), -normal.dot(place));
    quadric *= weight;
    return quadric;
}

/// One quadric per vertex: the planes of its faces, weighted by area. At boundary edges, which
/// these do not preserve, a plane through the edge, perpendicular to its face, is added.
std::vector<Quadricd> quadrics(const HalfEdgeMesh& mesh)
{
    constexpr double kRimWeight = 4.0;
    std::vector<Quadricd> result(mesh.n_vertices());
    parallel_for(result.size(), [&](std::size_t v) {
        const auto vertex = handle_at<VertexHandle>(v);
        const auto add_rim = [&](HalfedgeHandle inner) {
            Vector3d normal;
            mesh.calc_sector_normal(inner, normal);
            const Vector3d along = mesh.calc_edge_vector(inner);
            const Vector3d across = normal.cross(along).normalized();
            result[v] += plane(across, mesh.point(vertex), kRimWeight * along.squaredNorm());
        };
        for (const auto half_edge : mesh.voh_range(vertex)) {
            const auto outgoing = handle_at<HalfedgeHandle>(index(half_edge));
            const HalfedgeHandle incoming = mesh.opposite_halfedge_handle(outgoing);
            if (mesh.is_boundary(outgoing)) {
                add_rim(incoming);
                continue;
            }
            if (mesh.is_boundary(incoming)) add_rim(outgoing);
            const Triangle t = mesh.triangle(mesh.face_handle(outgoing));
            const Vector3d normal = scaled_normal(t[0], t[1], t[2]);
            result[v] += plane(normal.normalized(), t[0], normal.norm() / 2.0);
        }
    });
    return result;
}

/// 1 for an equilateral triangle, 0 for one without area.
double roundness(const Triangle& t)
{
    const double sum_sq =
        (t[1] - t[0]).squaredNorm() + (t[2] - t[1]).squaredNorm() + (t[0] - t[2]).squaredNorm();
    const double twice_area = scaled_normal(t[0], t[1], t[2]).norm();
    return sum_sq > 0.0 ? 2.0 * std::sqrt(3.0) * twice_area / sum_sq : 0.0;
}

/// Calls visit(before, after) for each face that collapsing a half-edge changes, until it returns
/// false. Returns whether all calls returned true.
template <typename Visit>
bool all_changed_faces(const HalfEdgeMesh& mesh, HalfedgeHandle half_edge, const Visit& visit)
{
    const VertexHandle from = mesh.from_vertex_handle(half_edge);
    const VertexHandle to = mesh.to_vertex_handle(half_edge);
    for (const auto face : mesh.vf_range(from)) {
        const auto corners = mesh.corners(face);
        if (std::ranges::count(corners, to) > 0) continue;
        const Triangle before = mesh.triangle(face);
        Triangle after = before;
        after[static_cast<std::size_t>(std::ranges::find(corners, from) - corners.begin())] =
            mesh.point(to);
        if (!visit(before, after)) return false;
    }
    return true;
}

/// Whether no face turns too far or becomes a worse sliver than the replaced faces.
bool keeps_faces_in_shape(const HalfEdgeMesh& mesh, HalfedgeHandle half_edge)
{
    constexpr double kMostTurnCosine = 0.5; // 60 degrees
    constexpr double kSliver = 0.1;         // of roundness
    double least = kSliver;
    for (const auto face : mesh.vf_range(mesh.from_vertex_handle(half_edge))) {
        least = std::min(least, roundness(mesh.triangle(face)));
    }
    return all_changed_faces(mesh, half_edge, [&](const Triangle& before, const Triangle& after) {
        const Vector3d was = scaled_normal(before[0], before[1], before[2]);
        const Vector3d is = scaled_normal(after[0], after[1], after[2]);
        return was.dot(is) >= kMostTurnCosine * was.norm() * is.norm() && roundness(after) >= least;
    });
}

/// Whether the surface stays manifold and keeps its components, handles and boundary loops. These
/// are the conditions of OpenMesh's decimater.
bool keeps_topology(HalfEdgeMesh& mesh, HalfedgeHandle half_edge)
{
    if (!mesh.is_collapse_ok(half_edge)) return false;
    const HalfedgeHandle twin = mesh.opposite_halfedge_handle(half_edge);
    const auto opposite = [&](HalfedgeHandle side) {
        return mesh.is_boundary(side) ? VertexHandle()
                                      : mesh.to_vertex_handle(mesh.next_halfedge_handle(side));
    };
    const VertexHandle left = opposite(half_edge);
    const VertexHandle right = opposite(twin);
    const bool is_inner = left.is_valid() && right.is_valid();
    const bool is_tetrahedron = is_inner && mesh.find_halfedge(left, right).is_valid() &&
                                mesh.valence(left) == 3 && mesh.valence(right) == 3;
    const bool leaves_rim = is_inner && mesh.is_boundary(mesh.from_vertex_handle(half_edge));
    const auto turned = [&](HalfedgeHandle h) { return mesh.cw_rotated_halfedge_handle(h); };
    return !is_tetrahedron && !leaves_rim && turned(turned(half_edge)) != half_edge;
}

/// The collapse of a half-edge, from its start to its end, and the cost.
struct Collapse {
    double cost = kNever;
    HalfedgeHandle half_edge;

    friend bool operator<(const Collapse& a, const Collapse& b)
    {
        return a.cost != b.cost ? a.cost < b.cost : a.half_edge < b.half_edge;
    }
};

/// Collapses edges in passes. Each pass selects some of the cheapest edges without common faces, so
/// that threads can test them concurrently. The guard is the most expensive test, so it runs only
/// for selected edges.
class Collapser {
  public:
    Collapser(HalfEdgeMesh& mesh, const RayGuard& guard)
        : mesh_(mesh),
          guard_(guard),
          quadrics_(quadrics(mesh)),
          best_(mesh.n_vertices()),
          is_changed_(mesh.n_vertices(), 1),
          is_refused_(mesh.n_halfedges(), 0),
          neighbor_in_(mesh.n_vertices(), 0),
          faces_(num_faces_left(mesh))
    {
        for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
            const auto vertex = handle_at<VertexHandle>(v);
            if (!mesh.is_deleted(vertex)) vertices_.push_back(vertex);
        }
    }

    std::int64_t faces() const { return faces_; }

    /// Stops at about `wanted` faces. Returns whether there were candidates.
    bool pass(std::int64_t wanted, const Progress& progress)
    {
        look_at_changed();
        const std::vector<Collapse> chosen = choose(wanted);
        std::vector<std::uint8_t> hides(chosen.size());
        parallel_for(
            chosen.size(), progress,
            [&](std::size_t i) { hides[i] = blocks_rays(chosen[i].half_edge) ? 1 : 0; }, 16);
        for (std::size_t i = 0; i < chosen.size() && faces_ > wanted; ++i) {
            if (hides[i] != 0) {
                refuse(chosen[i].half_edge);
            } else if (keeps_topology(mesh_, chosen[i].half_edge)) {
                collapse(chosen[i].half_edge);
            }
        }
        return has_tried_;
    }

  private:
    /// Recomputes the cheapest collapse of changed vertices.
    void look_at_changed()
    {
        std::erase_if(vertices_, [&](VertexHandle v) { return mesh_.is_deleted(v); });
        parallel_for_with_list<Collapse>(vertices_.size(), [&](std::size_t i, auto& collapses) {
            const std::size_t v = index(vertices_[i]);
            if (is_changed_[v] == 0) return;
            is_changed_[v] = 0;
            for (const auto outgoing : mesh_.voh_range(vertices_[i])) {
                if (is_refused_[index(outgoing)] != 0) continue;
                const VertexHandle to = mesh_.to_vertex_handle(outgoing);
                Quadricd quadric = quadrics_[v];
                quadric += quadrics_[index(to)];
                // Zero costs must compare equal despite rounding.
                collapses.push_back({std::max(quadric(mesh_.point(to)), 0.0), outgoing});
            }
            std::ranges::sort(collapses, std::less<>());
            const auto found = std::ranges::find_if(collapses, [&](const Collapse& collapse) {
                return keeps_faces_in_shape(mesh_, collapse.half_edge);
            });
            best_[v] = found == collapses.end() ? Collapse() : *found;
        });
    }

    /// The cheapest quarter of the collapses, sorted.
    std::vector<Collapse> cheapest() const
    {
        constexpr std::size_t kShare = 4; // one in four
        std::vector<Collapse> all;
        for (const VertexHandle vertex : vertices_) {
            const Collapse& best = best_[index(vertex)];
            if (best.cost < kNever) all.push_back(best);
        }
        const std::size_t count = (all.size() + kShare - 1) / kShare;
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
        if (end != all.end()) std::nth_element(all.begin(), end, all.end());
        all.resize(count);
        std::ranges::sort(all, std::less<>());
        return all;
    }

    /// A subset of these whose start vertices are pairwise not adjacent.
    std::vector<Collapse> choose(std::int64_t wanted)
    {
        ++pass_;
        std::vector<Collapse> chosen;
        const std::vector<Collapse> candidates = cheapest();
        has_tried_ = !candidates.empty();
        for (const Collapse& candidate : candidates) {
            if (2 * static_cast<std::int64_t>(chosen.size()) >= faces_ - wanted) break;
            const VertexHandle vertex = mesh_.from_vertex_handle(candidate.half_edge);
            if (neighbor_in_[index(vertex)] == pass_) continue;
            if (!keeps_topology(mesh_, candidate.half_edge)) {
                refuse(candidate.half_edge);
                continue;
            }
            for (const auto neighbor : mesh_.vv_range(vertex)) {
                neighbor_in_[index(neighbor)] = pass_;
            }
            chosen.push_back(candidate);
        }
        // Vertices with close indices are close in space, which speeds up ray queries.
        std::ranges::sort(chosen, {}, [&](const Collapse& collapse) {
            return mesh_.from_vertex_handle(collapse.half_edge).idx();
        });
        return chosen;
    }

    /// Whether collapsing a half-edge would block a free ray.
    bool blocks_rays(HalfedgeHandle half_edge) const
    {
        std::vector<Triangle> before;
        std::vector<Triangle> after;
        for (const auto face : mesh_.vf_range(mesh_.from_vertex_handle(half_edge)))
            before.push_back(mesh_.triangle(face));
        all_changed_faces(mesh_, half_edge, [&](const Triangle& /*before*/, const Triangle& is) {
            after.push_back(is);
            return true;
        });
        return guard_.blocks(before, after);
    }

    void refuse(HalfedgeHandle half_edge)
    {
        is_refused_[index(half_edge)] = 1;
        is_changed_[index(mesh_.from_vertex_handle(half_edge))] = 1;
    }

    void collapse(HalfedgeHandle half_edge)
    {
        const VertexHandle to = mesh_.to_vertex_handle(half_edge);
        quadrics_[index(to)] += quadrics_[index(mesh_.from_vertex_handle(half_edge))];
        faces_ -= mesh_.is_boundary(mesh_.edge_handle(half_edge)) ? 1 : 2;
        mesh_.collapse(half_edge);
        change(to);
        for (const auto neighbor : mesh_.vv_range(to)) {
            change(neighbor);
        }
    }

    /// Marks a vertex as changed. Its rejected collapses may be possible now.
    void change(VertexHandle vertex)
    {
        is_changed_[index(vertex)] = 1;
        for (const auto outgoing : mesh_.voh_range(vertex)) {
            is_refused_[index(outgoing)] = 0;
        }
    }

    HalfEdgeMesh& mesh_;
    const RayGuard& guard_;
    std::vector<Quadricd> quadrics_;
    std::vector<VertexHandle> vertices_;     ///< not deleted at the start of the pass
    std::vector<Collapse> best_;             ///< cheapest collapse of each vertex
    std::vector<std::uint8_t> is_changed_;   ///< whether best_ is outdated
    std::vector<std::uint8_t> is_refused_;   ///< one per half-edge
    std::vector<std::uint32_t> neighbor_in_; ///< last pass with a chosen vertex beside it
    std::uint32_t pass_ = 0;
    bool has_tried_ = false;
    std::int64_t faces_;
};

} // namespace

SimplifyCounts simplify_surface(HalfEdgeMesh& mesh, const RayGuard& guard,
                                const SimplifyOptions& options, const Progress& progress)
{
    SimplifyCounts counts{.faces_before = num_faces_left(mesh)};
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    Collapser collapser(mesh, guard);
    const auto done = [&, all = static_cast<double>(counts.faces_before - options.faces)] {
        return static_cast<double>(counts.faces_before - collapser.faces()) / all;
    };
    while (collapser.faces() > options.faces &&
           collapser.pass(options.faces, progress.part(done(), done()))) {
    }
    mesh.release_edge_status();
    mesh.release_halfedge_status();
    set_vertex_normals(mesh);
    counts.faces = collapser.faces();
    return counts;
}

} // namespace vcarve
