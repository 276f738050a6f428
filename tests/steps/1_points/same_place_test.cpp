#include "steps/1_points/same_place.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vcarve::same_place_test {
namespace {

using Eigen::Vector3d;
using Numbers = std::vector<std::uint32_t>;

Numbers all_of(std::size_t count)
{
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

/// The corners of a box whose middle half has a diagonal of 1.
std::vector<Vector3d> corners()
{
    const Vector3d side = Vector3d::Ones() / std::sqrt(3.0);
    std::vector<Vector3d> places;
    for (int i = 0; i < 8; ++i) {
        places.push_back(
            Vector3d((i & 1) * side.x(), (i >> 1 & 1) * side.y(), (i >> 2) * side.z()));
    }
    return places;
}

TEST(FirstAtPlace, IsTheLeastOfThoseNearerThanABillionthOfTheSize)
{
    std::vector<Vector3d> places = corners();
    places.push_back(places[3]);                                // 8: the same
    places.emplace_back(places[5] + Vector3d(0.9e-9, 0, 0));    // 9: near enough
    places.emplace_back(places[6] + Vector3d(0, 1.1e-9, 0));    // 10: not
    places.emplace_back(places[5] + Vector3d(1.7e-9, 0, 0));    // 11: near to 9
    places.emplace_back(places[1] - Vector3d(0, 1e-16, 1e-16)); // 12: by rounding
    Numbers expected = all_of(places.size());
    expected[8] = 3;
    expected[9] = 5;
    expected[11] = 5;
    expected[12] = 1;
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

TEST(FirstAtPlace, LeavesAloneWhatIsNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vector3d> places = corners();
    places.emplace_back(nan, 0, 0);
    places.emplace_back(nan, 0, 0);
    EXPECT_EQ(first_at_place(places, all_of(8)), all_of(10));
}

TEST(FirstAtPlace, IsTheSameWhereRoundingIsCoarse)
{
    // As far off as UTM coordinates are, where doubles are 1e-9 apart.
    const Vector3d way(5e5, 4.6e6, 100.0);
    const Positions places = random_points(2000, 77);
    std::vector<Vector3d> near;
    std::vector<Vector3d> far;
    Numbers expected;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const bool again = i % 10 == 9; // the point before
        const Vector3d place =
            again ? Vector3d(near[i - 1] * (1.0 + 4e-16)) : Vector3d(40.0 * places[i]);
        near.push_back(place);
        far.push_back(place + way);
        expected.push_back(again ? i - 1 : i);
    }
    EXPECT_EQ(first_at_place(near, all_of(near.size())), expected);
    EXPECT_EQ(first_at_place(far, all_of(far.size())), expected);
}

TEST(FirstAtPlace, JudgesAPartByItselfHoweverFarTheRestLies)
{
    for (const double away : {1e12, 1e50, 1e100}) {
        const double size = std::max(1.0, 1e-12 * away); // of the part, so that it has digits
        const Positions places = random_points(1000, 5);
        std::vector<Vector3d> parts = places;
        for (const Vector3d& place : places) {
            parts.emplace_back(size * place + Vector3d(0, away, 0));
        }
        Numbers expected = all_of(parts.size());
        EXPECT_EQ(first_at_place(parts, expected), expected) << away;
        parts.push_back(parts[3]);
        parts.emplace_back(parts[1500] * (1.0 + 4e-16));
        expected.insert(expected.end(), {3, 1500});
        EXPECT_EQ(first_at_place(parts, all_of(parts.size())), expected) << away;
    }
}

TEST(FirstAtPlace, IsOneForManyCopiesToo)
{
    std::vector<Vector3d> places = random_points(1000, 6);
    Numbers expected = all_of(places.size());
    for (int copy = 0; copy < 100; ++copy) {
        places.emplace_back(places[7] * (1.0 + 2e-16 * (copy % 3)));
        expected.push_back(7);
    }
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

TEST(FirstAtPlace, TellsPointsOfAPlaneAcrossAnAxisApart)
{
    std::vector<Vector3d> places;
    Numbers expected;
    for (std::uint32_t i = 0; i < 20'000; ++i) { // more than are compared at one distance
        places.emplace_back(0.5, i / 200, i % 200);
        expected.push_back(i);
    }
    places.emplace_back(0.5, 99.0, 7.0);
    expected.push_back(99 * 200 + 7);
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

} // namespace
} // namespace vcarve::same_place_test
