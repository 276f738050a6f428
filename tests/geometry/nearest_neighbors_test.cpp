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

TEST(Neighborhoods, ContainNoMoreThanWantedIfPointsCoincide)
{
    const Neighborhoods near = nearest_neighborhoods(std::vector<Vector3d>(9, {1, 2, 3}), 2);
    for (std::uint32_t point = 0; point < 9; ++point) {
        EXPECT_EQ(near.around(point).size(), 2U);
        EXPECT_EQ(near.reach_sq(point), 0.0);
    }
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
