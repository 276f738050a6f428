#include "geometry/neighborhoods.h"

#include "base/parallel.h"
#include "geometry/nearest_neighbors.h"

#include <algorithm>

namespace vcarve {

void Neighborhoods::set(std::size_t point, std::span<const std::uint32_t> around, double reach_sq)
{
    std::ranges::copy(around, points_.begin() + static_cast<std::ptrdiff_t>(most_ * point));
    counts_[point] = static_cast<std::uint32_t>(around.size());
    reaches_sq_[point] = reach_sq;
}

Neighborhoods nearest_neighborhoods(const std::vector<Eigen::Vector3d>& positions,
                                    std::size_t count, const Progress& progress)
{
    const std::size_t kept = std::min(count, positions.size() - 1);
    const NearestNeighbors tree(positions);
    progress.tell(0.4);
    Neighborhoods neighborhoods(positions.size(), kept);
    parallel_for_ranges(positions.size(), progress.part(0.4, 1.0),
                        [&](std::size_t first, std::size_t last) {
                            std::vector<NearestNeighbors::Neighbor> nearest;
                            std::vector<std::uint32_t> around;
                            for (std::size_t i = first; i < last; ++i) {
                                tree.find(positions[i], kept + 1, nearest);
                                around.clear();
                                for (const auto& neighbor : nearest) {
                                    if (neighbor.point != i) around.push_back(neighbor.point);
                                }
                                neighborhoods.set(i, around, nearest.back().distance_sq);
                            }
                        });
    return neighborhoods;
}

} // namespace vcarve
