#include "steps/1_points/same_place.h"

#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/union_find.h"
#include "model/middle_box.h"

#include <algorithm>
#include <cstddef>

namespace vcarve {

namespace {

using Eigen::Vector3d;

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

double same_place_size(const std::vector<Vector3d>& positions,
                       const std::vector<std::uint32_t>& finite)
{
    constexpr double kSame = 1e-9;
    constexpr double kMiddleHalf = 0.25; // left out at either end
    std::vector<Vector3d> places(finite.size());
    parallel_for(finite.size(), [&](std::size_t i) { places[i] = positions[finite[i]]; });
    const auto box = middle_box(places, kMiddleHalf);
    return box.isEmpty() ? 0.0 : kSame * box.diagonal().norm();
}

} // namespace

std::vector<std::uint32_t> first_at_place(const std::vector<Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite)
{
    const Vector3d direction(0.5377, 0.3183, 0.7807);
    constexpr std::size_t kMostCompared = 64; // however many lie equally far
    const double size = same_place_size(positions, finite);
    std::vector<Along> order(finite.size());
    parallel_for(finite.size(), [&](std::size_t i) {
        order[i] = {direction.dot(positions[finite[i]]), finite[i]};
    });
    parallel_sort(order);

    UnionFind places(positions.size());
    const double reach = 2.0 * direction.sum() * size; // twice, for rounding
    parallel_for(order.size(), [&](std::size_t i) {
        const std::size_t end = std::min(order.size(), i + 1 + kMostCompared);
        for (std::size_t j = i + 1; j < end && order[j].way - order[i].way <= reach; ++j) {
            const Vector3d apart = positions[order[i].point] - positions[order[j].point];
            if (apart.cwiseAbs().maxCoeff() <= size) places.join(order[i].point, order[j].point);
        }
    });
    std::vector<std::uint32_t> firsts(positions.size());
    parallel_for(firsts.size(), [&](std::size_t point) {
        firsts[point] = places.root(static_cast<std::uint32_t>(point));
    });
    return firsts;
}

} // namespace vcarve
