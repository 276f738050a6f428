#include "steps/1_points/same_place.h"

#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/union_find.h"
#include "model/middle_box.h"
#include "model/scene_points.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;
using Points = std::vector<std::uint32_t>;

/// A point by how far it lies along a direction that no surface of a scene is likely to stand
/// across, so that few points lie equally far.
struct Along {
    double way;
    std::uint32_t point;

    bool operator<(const Along& other) const
    {
        return way != other.way ? way < other.way : point < other.point;
    }
};

double same_place_size(const Positions& positions, const Points& points)
{
    constexpr double kSame = 1e-9;
    constexpr double kMiddleHalf = 0.25; // left out at either end
    const Positions places = values_at(points, positions);
    const auto box = middle_box(places, kMiddleHalf);
    return box.isEmpty() ? 0.0 : kSame * box.diagonal().norm();
}

/// As many digits as the coordinates of some points have in common with those of their copies.
double rounding_of(const Positions& positions, const Points& points)
{
    double largest = 0.0;
    for (const std::uint32_t point : points) {
        largest = std::max(largest, positions[point].cwiseAbs().maxCoeff());
    }
    return 4.0 * std::numeric_limits<double>::epsilon() * largest;
}

/// For every entry of `points`, which ascend, the first entry at its place.
Points join_within(double size, const Positions& positions, const Points& points)
{
    const Vector3d direction(0.5377, 0.3183, 0.7807);
    constexpr std::size_t kMostCompared = 64; // however many lie equally far
    std::vector<Along> order(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        order[i] = {direction.dot(positions[points[i]]), static_cast<std::uint32_t>(i)};
    });
    parallel_sort(order);

    UnionFind places(points.size());
    const auto position_of = [&](const Along& along) { return positions[points[along.point]]; };
    const double reach = 2.0 * direction.sum() * size; // twice, for rounding
    parallel_for(order.size(), [&](std::size_t i) {
        const std::size_t end = std::min(order.size(), i + 1 + kMostCompared);
        for (std::size_t j = i + 1; j < end && order[j].way - order[i].way <= reach; ++j) {
            const Vector3d apart = position_of(order[i]) - position_of(order[j]);
            if (apart.cwiseAbs().maxCoeff() <= size) places.join(order[i].point, order[j].point);
        }
    });
    std::vector<Along>().swap(order); // before there is more
    Points firsts(points.size());
    parallel_for(firsts.size(),
                 [&](std::size_t i) { firsts[i] = places.root(static_cast<std::uint32_t>(i)); });
    return firsts;
}

/// A place of many points may be a small part of the scene, far from the rest: it is judged by
/// itself.
void find_firsts(double size, const Positions& positions, const Points& points, Points& firsts)
{
    constexpr std::uint32_t kMostCopies = 8;
    const Points joined = join_within(size, positions, points);
    if (firsts.empty()) {
        firsts.resize(positions.size()); // only now: joining takes the most memory
        std::iota(firsts.begin(), firsts.end(), 0U);
    }
    Points counts(points.size());
    for (const std::uint32_t first : joined) {
        ++counts[first];
    }
    std::map<std::uint32_t, Points> crowds;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t count = counts[joined[i]];
        if (count > kMostCopies && count < points.size()) {
            crowds[joined[i]].push_back(points[i]);
        } else {
            firsts[points[i]] = points[joined[i]];
        }
    }
    for (const auto& [first, crowd] : crowds) {
        const double own_size =
            std::max(same_place_size(positions, crowd), rounding_of(positions, crowd));
        find_firsts(std::min(own_size, size), positions, crowd, firsts);
    }
}

} // namespace

std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite)
{
    Points firsts;
    find_firsts(same_place_size(positions, finite), positions, finite, firsts);
    return firsts;
}

} // namespace vcarve
