#include "geometry/point_tree.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {

PointTree::PointTree(const std::vector<Eigen::Vector3d>& points) : points_(points)
{
    levels_.emplace_back((points.size() + kLeaf - 1) / kLeaf);
    parallel_for(levels_[0].size(), [&](std::size_t node) {
        const PointRun run = run_of(0, node);
        Box box{points[run.first], points[run.first]};
        for (std::size_t i = run.first; i < run.last; ++i) {
            box = {box.low.cwiseMin(points[i]), box.high.cwiseMax(points[i])};
        }
        levels_[0][node] = box;
    });
    while (levels_.back().size() > 1) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> level((below.size() + kFanout - 1) / kFanout);
        for (std::size_t node = 0; node < level.size(); ++node) {
            level[node] = below[node * kFanout];
            const std::size_t last = std::min(below.size(), (node + 1) * kFanout);
            for (std::size_t child = node * kFanout; child < last; ++child) {
                level[node] = {level[node].low.cwiseMin(below[child].low),
                               level[node].high.cwiseMax(below[child].high)};
            }
        }
        levels_.push_back(std::move(level));
    }
}

void PointTree::find_nearest(const Eigen::Vector3d& place, std::size_t count,
                             std::vector<Near>& nearest) const
{
    nearest.clear();
    if (points_.empty() || count == 0) return;
    double most = std::numeric_limits<double>::infinity();
    visit_near(place, {0, 0}, most, [&](std::size_t i) {
        const Near near{(points_[i] - place).norm(), i};
        if (nearest.size() == count) {
            if (!(near < nearest.back())) return;
            nearest.pop_back();
        }
        nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), near), near);
        if (nearest.size() == count) most = nearest.back().distance;
    });
}

std::vector<double> PointTree::distances_to_others(const PointRun& own) const
{
    std::vector<double> distances;
    std::size_t nearest_point = points_.size(); // to the previous leaf: a good first bound
    for (std::size_t leaf = own.first / kLeaf; leaf * kLeaf < own.last; ++leaf) {
        const Box& box = levels_[0][leaf];
        const auto distance_to = [&](std::size_t i) {
            return distance_between(box, {points_[i], points_[i]});
        };
        double nearest = nearest_point < points_.size() ? distance_to(nearest_point)
                                                        : std::numeric_limits<double>::infinity();
        visit_excluding(
            own, nearest, [&](const Box& other) { return distance_between(box, other); },
            [&](std::size_t i) {
                if (!(distance_to(i) < nearest)) return;
                nearest = distance_to(i);
                nearest_point = i;
            });
        distances.push_back(nearest);
    }
    return distances;
}

} // namespace vcarve
