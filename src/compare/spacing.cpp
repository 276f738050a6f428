#include "compare/spacing.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "geometry/nearest_neighbors.h"

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

constexpr std::size_t kNeighbor = 6;
constexpr double kLeastShareOfMedian = 0.01;

} // namespace

std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points)
{
    const NearestNeighbors tree(points);
    std::vector<double> spacings(points.size());
    parallel_for_ranges(points.size(), [&](std::size_t first, std::size_t last) {
        std::vector<NearestNeighbors::Neighbor> nearest;
        for (std::size_t i = first; i < last; ++i) {
            tree.find(points[i], kNeighbor + 1, nearest); // the nearest of all is the point itself
            spacings[i] = std::sqrt(nearest.back().distance_sq);
        }
    });
    const double least = kLeastShareOfMedian * median(spacings);
    for (double& spacing : spacings) {
        spacing = std::max(spacing, least);
    }
    return spacings;
}

} // namespace vcarve
