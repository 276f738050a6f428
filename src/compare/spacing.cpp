#include "compare/spacing.h"

#include "base/median.h"
#include "base/parallel.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

constexpr unsigned kNeighbor = 6;
constexpr double kLeastShareOfMedian = 0.01;

Point to_point(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

} // namespace

std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points)
{
    Search::Tree tree;
    tree.reserve(points.size());
    for (const Eigen::Vector3d& point : points) {
        tree.insert(to_point(point));
    }
    tree.build();
    // The nearest of all is the point itself.
    std::vector<double> spacings(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        double farthest_sq = 0.0;
        for (const auto& [point, distance_sq] : Search(tree, to_point(points[i]), kNeighbor + 1)) {
            farthest_sq = std::max(farthest_sq, distance_sq);
        }
        spacings[i] = std::sqrt(farthest_sq);
    });
    const double least = kLeastShareOfMedian * median(spacings);
    for (double& spacing : spacings) {
        spacing = std::max(spacing, least);
    }
    return spacings;
}

} // namespace vcarve
