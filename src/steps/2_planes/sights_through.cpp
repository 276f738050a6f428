#include "steps/2_planes/sights_through.h"

#include "base/parallel.h"
#include "geometry/triangle_tree.h"

#include <atomic>

namespace vcarve {

using Eigen::Vector3d;

std::vector<std::uint32_t> sights_through(const Scene& scene,
                                          std::span<const std::array<Vector3d, 3>> triangles,
                                          const std::vector<double>& margins,
                                          const Progress& progress)
{
    std::vector<std::uint32_t> counts(triangles.size());
    if (triangles.empty()) return counts;
    const TriangleTree tree(triangles);
    const auto count = [&](std::size_t triangle) {
        std::atomic_ref(counts[triangle]).fetch_add(1, std::memory_order_relaxed);
    };
    parallel_for(scene.num_points(), progress, [&](std::size_t point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            visit_sight(
                scene, point, view, margins[point],
                [&](const Vector3d& from, const Vector3d& to) { tree.visit_met(from, to, count); });
        }
    });
    return counts;
}

} // namespace vcarve
