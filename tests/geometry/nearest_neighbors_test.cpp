#include "base/random_number.h"
#include "geometry/nearest_neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vcarve::nearest_neighbors_test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> random_points(std::uint64_t count)
{
    std::vector<Vector3d> points;
    for (std::uint64_t i = 0; i < count; ++i) {
        points.emplace_back(random_number(3, 3 * i), random_number(3, 3 * i + 1),
                            0.1 * random_number(3, 3 * i + 2));
    }
    return points;
}

/// All points by their squared distances to a place.
std::vector<std::pair<double, std::uint32_t>> sorted_from(const Vector3d& place,
                                                          const std::vector<Vector3d>& points)
{
    std::vector<std::pair<double, std::uint32_t>> sorted;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sorted.emplace_back((points[i] - place).squaredNorm(), i);
    }
    std::ranges::sort(sorted);
    return sorted;
}

TEST(NearestNeighbors, AreThoseFoundBySorting)
{
    const std::vector<Vector3d> points = random_points(500);
    const NearestNeighbors tree(points);
    std::vector<NearestNeighbors::Neighbor> nearest;
    for (const Vector3d& place : random_points(50)) {
        const auto sorted = sorted_from(place, points);
        tree.find(place, 7, nearest);
        ASSERT_EQ(nearest.size(), 7U);
        for (std::size_t k = 0; k < nearest.size(); ++k) {
            EXPECT_EQ(nearest[k].point, sorted[k].second);
            EXPECT_DOUBLE_EQ(nearest[k].distance_sq, sorted[k].first);
        }
    }
}

TEST(NearestNeighbors, SayWhetherOneIsNearer)
{
    const NearestNeighbors tree({{0, 0, 0}, {10, 0, 0}});
    EXPECT_FALSE(tree.has_nearer({3, 4, 0}, 5.0)); // as far, not nearer
    EXPECT_TRUE(tree.has_nearer({3, 4, 0}, 5.001));
    EXPECT_FALSE(NearestNeighbors({}).has_nearer({3, 4, 0}, 5.0));
}

TEST(NearestNeighbors, AreAllWhereThereAreFewer)
{
    std::vector<NearestNeighbors::Neighbor> nearest(3);
    NearestNeighbors({}).find(Vector3d::Zero(), 4, nearest);
    EXPECT_TRUE(nearest.empty());
    NearestNeighbors({{2, 0, 0}, {1, 0, 0}}).find(Vector3d::Zero(), 4, nearest);
    ASSERT_EQ(nearest.size(), 2U);
    EXPECT_EQ(nearest[0].point, 1U);
    EXPECT_EQ(nearest[1].point, 0U);
}

} // namespace
} // namespace vcarve::nearest_neighbors_test
