#include "base/numbers.h"
#include "geometry/nearest_neighbors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

namespace vcarve::nearest_neighbors_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

std::vector<Vector3d> random_points(std::uint64_t count)
{
    std::vector<Vector3d> points;
    for (std::uint64_t i = 0; i < count; ++i) {
        points.emplace_back(random_number(3, 3 * i), random_number(3, 3 * i + 1),
                            0.1 * random_number(3, 3 * i + 2));
    }
    return points;
}

/// All points with their squared distances to `place`, sorted by distance.
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

TEST(NearestNeighbors, MatchSortingByDistance)
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

TEST(NearestNeighbors, IncludeAllPointsIfThereAreFewer)
{
    std::vector<NearestNeighbors::Neighbor> nearest(3);
    NearestNeighbors({}).find(Vector3d::Zero(), 4, nearest);
    EXPECT_TRUE(nearest.empty());
    NearestNeighbors({{2, 0, 0}, {1, 0, 0}}).find(Vector3d::Zero(), 4, nearest);
    ASSERT_EQ(nearest.size(), 2U);
    EXPECT_EQ(nearest[0].point, 1U);
    EXPECT_EQ(nearest[1].point, 0U);
}

TEST(Neighborhoods, ContainNearestOtherPoints)
{
    const Neighborhoods near =
        nearest_neighborhoods({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}}, 2);
    EXPECT_THAT(near.around(0), ElementsAre(1, 2));
    EXPECT_THAT(near.around(1), ElementsAre(0, 2));
    EXPECT_THAT(near.around(3), ElementsAre(2, 1));
    EXPECT_EQ(near.reach_sq(1), 4.0);
    EXPECT_EQ(near.reach_sq(3), 36.0);
    EXPECT_EQ(near.spacing_sq(1), 2.0 * std::numbers::pi);
}

TEST(Neighborhoods, ContainAllOthersIfThereAreFewer)
{
    const Neighborhoods near = nearest_neighborhoods({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, 10);
    EXPECT_THAT(near.around(2), ElementsAre(1, 0));
    EXPECT_EQ(near.reach_sq(2), 9.0);
}

TEST(Neighborhoods, MatchBruteForce)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Vector3d> positions;
    for (int i = 0; i < 3000; ++i) {
        positions.emplace_back(unit(random), unit(random), unit(random));
    }
    const Neighborhoods near = nearest_neighborhoods(positions, 6);
    for (std::uint32_t point = 0; point < positions.size(); point += 50) {
        std::vector<std::pair<double, std::uint32_t>> others;
        for (std::uint32_t other = 0; other < positions.size(); ++other) {
            if (other != point) {
                others.emplace_back((positions[other] - positions[point]).squaredNorm(), other);
            }
        }
        std::partial_sort(others.begin(), others.begin() + 6, others.end());
        ASSERT_EQ(near.around(point).size(), 6U);
        for (std::size_t i = 0; i < 6; ++i) {
            ASSERT_EQ(near.around(point)[i], others[i].second);
        }
        ASSERT_DOUBLE_EQ(near.reach_sq(point), others[5].first);
    }
}

TEST(Neighborhoods, AreEmptyUntilSet)
{
    Neighborhoods made(2, 3);
    const std::vector<std::uint32_t> around = {0};
    made.set(1, around, 0.25);
    EXPECT_TRUE(made.around(0).empty());
    EXPECT_EQ(made.reach_sq(0), 0.0);
    EXPECT_THAT(made.around(1), ElementsAre(0));
    EXPECT_EQ(made.reach_sq(1), 0.25);
}

} // namespace
} // namespace vcarve::nearest_neighbors_test
