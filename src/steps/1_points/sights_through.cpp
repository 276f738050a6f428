#include "steps/1_points/sights_through.h"

#include "base/parallel.h"
#include "geometry/triangle_tree.h"

#include <algorithm>
#include <atomic>

namespace vcarve {

using Eigen::Vector3d;

std::vector<std::uint32_t> sights_through(const Scene& scene,
                                          std::span<const std::array<Vector3d, 3>> triangles,
                                          const std::vector<double>& margins,
                                          const Progress& progress)
{
    constexpr double kMostOfSight = 0.5;
    std::vector<std::uint32_t> counts(triangles.size());
    if (triangles.empty()) return counts;
    const TriangleTree tree(triangles);
    const auto count = [&](std::size_t triangle) {
        std::atomic_ref(counts[triangle]).fetch_add(1, std::memory_order_relaxed);
    };
    parallel_for(scene.num_points(), progress, [&](std::size_t point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            const Vector3d& center = scene.views[view].center;
            const Vector3d way = center - scene.positions[point];
            const double length = way.norm();
            if (length == 0.0) continue;
            const double left_out = std::min(margins[point] / length, kMostOfSight);
            tree.visit_met(scene.positions[point] + left_out * way, center, count);
        }
    });
    return counts;
}

} // namespace vcarve
