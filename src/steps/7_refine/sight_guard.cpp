#include "steps/7_refine/sight_guard.h"

#include "base/parallel.h"
#include "mesh/half_edge_mesh.h"

#include <algorithm>
#include <atomic>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// The share of the time that building the tree takes.
constexpr double kTreeShare = 0.3;
/// How many faces, which lie next to each other for the most part, are asked about at once.
constexpr std::size_t kNeighbors = 4;

/// Per point, how much of its sights does not count; of two vertices at a point the lesser.
std::vector<double> margins_of_points(const Scene& scene, const HalfEdgeMesh& surface)
{
    const std::vector<double> spacings = vertex_spacings(surface);
    std::vector<double> margins(scene.num_points(), 0.0);
    for (std::size_t v = 0; v < spacings.size(); ++v) {
        const auto vertex = handle_at<OpenMesh::VertexHandle>(v);
        const std::uint32_t point = surface.data(vertex).scene_point;
        if (point == kNoPoint || surface.is_deleted(vertex)) continue;
        double& margin = margins[point];
        margin = margin > 0.0 ? std::min(margin, spacings[v]) : spacings[v];
    }
    return margins;
}

} // namespace

SightGuard::SightGuard(const Scene& scene, const HalfEdgeMesh& surface, const Progress& progress)
    : tree_(scene, margins_of_points(scene, surface)), blocked_(tree_.size(), 0)
{
    progress.tell(kTreeShare);
    parallel_for_ranges(
        surface.n_faces(), progress.part(kTreeShare, 1.0),
        [&](std::size_t first, std::size_t last) {
            std::vector<std::array<Vector3d, 3>> triangles;
            for (std::size_t f = first; f < last; ++f) {
                const auto face = handle_at<OpenMesh::FaceHandle>(f);
                if (!surface.is_deleted(face)) triangles.push_back(surface.triangle(face));
            }
            tree_.visit_meeting(triangles, [&](std::size_t sight) {
                std::atomic_ref(blocked_[sight]).store(1, std::memory_order_relaxed);
                return true;
            });
        },
        kNeighbors);
}

bool SightGuard::blocks(std::span<const std::array<Vector3d, 3>> triangles) const
{
    bool found = false;
    tree_.visit_meeting(triangles, [&](std::size_t sight) {
        found = blocked_[sight] == 0;
        return !found;
    });
    return found;
}

std::int64_t SightGuard::num_free() const
{
    return std::ranges::count(blocked_, 0);
}

} // namespace vcarve
