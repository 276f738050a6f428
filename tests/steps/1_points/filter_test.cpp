#include "io/colmap/colmap_model.h"
#include "sample_scene.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/crop.h"
#include "steps/1_points/filter.h"
#include "support/many_points.h"
#include "support/point_sets.h"
#include "support/region_checks.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace vcarve::filter_test {
namespace {

using Eigen::Vector3d;

const std::vector<Vector3d> kCenters = {{0, 0, 10}, {4, 0, 10}, {0.01, 0, 10}};

FilterOptions all_off()
{
    return {.min_views = 1, .max_error_px = 0.0, .min_angle_deg = 0.0};
}

TEST(Filter, KeepsEveryGoodPointInOrder)
{
    const Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {0, 1, 2}}});
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1, 2}));
    EXPECT_EQ(result.scene.positions, scene.positions);
    EXPECT_EQ(result.scene.tracks.views, scene.tracks.views);
    EXPECT_EQ(result.report.non_finite + result.report.duplicate + result.report.few_views +
                  result.report.high_error + result.report.low_angle,
              0);
}

TEST(MedianAngle, IsTheAngleBetweenTheFirstRayAndTheFarthest)
{
    // The cameras are 10 away and at most 4 apart, so the angle is atan(0.4).
    const Scene wide = make_scene(kCenters, {{{0, 0, 0}, {0, 1, 2}}, {{0, 0, 0}, {0, 1}}});
    EXPECT_NEAR(median_angle_deg(wide), 21.80, 0.01);
    const Scene still = make_scene(kCenters, {{{0, 0, 0}, {0, 2}}, {{0, 0, 0}, {0}}});
    EXPECT_NEAR(median_angle_deg(still), 0.0573, 0.001);
    const Scene one_view = make_scene(kCenters, {{{0, 0, 0}, {0}}});
    EXPECT_EQ(median_angle_deg(one_view), 0.0);
}

TEST(Filter, CountsDroppedPointsByReason)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}},   // good
                                        {{nan, 0, 0}, {0, 1}}, // not finite
                                        {{2, 0, 0}, {0}},      // one view
                                        {{3, 0, 0}, {0, 1}},   // error, see below
                                        {{4, 0, 0}, {0, 2}}}); // 0.06 degrees between its rays
    scene.errors_px[3] = 4.5;
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.non_finite, 1);
    EXPECT_EQ(result.report.few_views, 1);
    EXPECT_EQ(result.report.high_error, 1);
    EXPECT_EQ(result.report.low_angle, 1);
    EXPECT_EQ(result.report.duplicate, 0);
}

TEST(Filter, DropsPointsBeyondTheLargestCoordinate)
{
    const Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}},
                                              {{1e160, 0, 0}, {0, 1}},
                                              {{0, -1e300, 0}, {0, 1}},
                                              {{0, 0, 1.1e100}, {0, 1}}});
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.non_finite, 3);
}

TEST(Filter, RequiresAnAngleOnlyForPointsWithSeveralViews)
{
    const Scene scene = make_scene(kCenters, {{{1, 0, 0}, {1}}, {{4, 0, 0}, {0, 2}}});
    const FilteredPoints result = filter_points(scene, {.min_views = 1});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.low_angle, 1);
}

TEST(Filter, KeepsViewsOfMergedPointsAfterDroppedPoints)
{
    const Scene scene = make_scene(kCenters, {{{2, 0, 0}, {0}},      // one view
                                              {{1, 0, 0}, {0, 1}},   // coincides
                                              {{1, 0, 0}, {1, 2}},   // with this
                                              {{4, 0, 0}, {0, 2}},   // 0.06 degrees
                                              {{3, 0, 0}, {0, 1}}}); // good
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{2, 5}));
    EXPECT_EQ(result.scene.tracks.begins, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(result.scene.tracks.views, (std::vector<std::uint32_t>{0, 1, 2, 0, 1}));
    EXPECT_EQ(result.scene.positions, (std::vector<Vector3d>{{1, 0, 0}, {3, 0, 0}}));
}

TEST(Filter, RequiresNoSecondViewForMeasuredRanges)
{
    Scene scene = make_scene(kCenters, {{{2, 0, 0}, {0}}, {{3, 0, 0}, {0, 2}}, {{4, 0, 0}, {1}}});
    scene.cameras.push_back(scene.cameras.front());
    scene.cameras.back().measures_range = true;
    scene.views[0].camera = static_cast<std::uint32_t>(scene.cameras.size() - 1);
    FilterOptions strict;
    strict.min_views = 3;
    strict.min_angle_deg = 45.0;
    const FilteredPoints result = filter_points(scene, strict);
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1, 2}));
    EXPECT_EQ(result.report.few_views, 1);
}

TEST(Filter, KeepsFinitePointsIfAllLimitsAreOff)
{
    Scene scene =
        make_scene(kCenters, {{{2, 0, 0}, {0}}, {{3, 0, 0}, {0, 1}}, {{4, 0, 0}, {0, 2}}});
    scene.errors_px[1] = 1e9;
    EXPECT_EQ(filter_points(scene, all_off()).scene.num_points(), 3U);
}

TEST(Filter, KeepsPointsWithUnknownError)
{
    Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}}});
    scene.errors_px[0] = -1.0;
    EXPECT_EQ(filter_points(scene, {}).scene.num_points(), 1U);
}

TEST(Filter, MergesCoincidentPointsAndTheirViews)
{
    Scene scene = make_scene(
        kCenters,
        {{{1, 0, 0}, {0}}, {{7, 7, 7}, {0, 1}}, {{1, 0, 0}, {1, 2}}, {{1, 0, 0}, {0, 2}}});
    scene.errors_px[3] = 0.25; // as many views as the third, but a smaller error: the best
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.report.duplicate, 2);
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{2, 4}));
    EXPECT_EQ(result.scene.colors[1], scene.colors[3]);
    EXPECT_EQ(result.scene.errors_px[1], 0.25);
    EXPECT_EQ(result.scene.tracks.views, (std::vector<std::uint32_t>{0, 1, 0, 1, 2}));
}

TEST(Filter, UsesTheWidestAngleBetweenRays)
{
    // The rays to views 0 and 2 differ by 0.06 degrees, and view 1 by about 22 degrees.
    const Scene scene = make_scene(kCenters, {{{0, 0, 0}, {0, 1, 2}}});
    FilterOptions options;
    options.min_angle_deg = 21.0;
    EXPECT_EQ(filter_points(scene, options).scene.num_points(), 1U);
    options.min_angle_deg = 23.0;
    EXPECT_EQ(filter_points(scene, options).scene.num_points(), 0U);
}

TEST(Filter, KeepsNormalsOfKeptPoints)
{
    Scene scene =
        make_scene(kCenters, {{{1, 0, 0}, {0, 1}}, {{2, 0, 0}, {0}}, {{3, 0, 0}, {0, 1}}});
    EXPECT_TRUE(filter_points(scene, {}).scene.normals.empty());
    scene.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(filter_points(scene, {}).scene.normals,
              (std::vector<Eigen::Vector3f>{{1, 0, 0}, {0, 0, 1}}));
}

using Numbers = std::vector<std::uint32_t>;

Numbers all_of(std::size_t count)
{
    Numbers numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

/// The corners of a box; the middle half of the points has a box with diagonal 1.
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

TEST(FirstAtPlace, IsTheFirstPointWithinABillionthOfTheSize)
{
    std::vector<Vector3d> places = corners();
    places.push_back(places[3]);                                // 8: equal
    places.emplace_back(places[5] + Vector3d(0.9e-9, 0, 0));    // 9: close enough
    places.emplace_back(places[6] + Vector3d(0, 1.1e-9, 0));    // 10: too far
    places.emplace_back(places[5] + Vector3d(1.7e-9, 0, 0));    // 11: close to 9
    places.emplace_back(places[1] - Vector3d(0, 1e-16, 1e-16)); // 12: rounding
    Numbers expected = all_of(places.size());
    expected[8] = 3;
    expected[9] = 5;
    expected[11] = 5;
    expected[12] = 1;
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

TEST(FirstAtPlace, DoesNotMergeNonFinitePoints)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vector3d> places = corners();
    places.emplace_back(nan, 0, 0);
    places.emplace_back(nan, 0, 0);
    EXPECT_EQ(first_at_place(places, all_of(8)), all_of(10));
}

TEST(FirstAtPlace, MergesTheSamePointsIfRoundingIsCoarse)
{
    // The size of UTM coordinates, which have a precision of 1e-9.
    const Vector3d way(5e5, 4.6e6, 100.0);
    const Positions places = random_points(2000, 77);
    std::vector<Vector3d> near;
    std::vector<Vector3d> far;
    Numbers expected;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const bool again = i % 10 == 9; // copies the point before
        const Vector3d place =
            again ? Vector3d(near[i - 1] * (1.0 + 4e-16)) : Vector3d(40.0 * places[i]);
        near.push_back(place);
        far.push_back(place + way);
        expected.push_back(again ? i - 1 : i);
    }
    EXPECT_EQ(first_at_place(near, all_of(near.size())), expected);
    EXPECT_EQ(first_at_place(far, all_of(far.size())), expected);
}

TEST(FirstAtPlace, ComparesAFarPartByItsOwnSize)
{
    for (const double away : {1e12, 1e50, 1e100}) {
        const double size =
            std::max(1.0, 1e-12 * away); // large enough for the precision of doubles
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

TEST(FirstAtPlace, MergesManyCopies)
{
    std::vector<Vector3d> places = random_points(1000, 6);
    Numbers expected = all_of(places.size());
    for (int copy = 0; copy < 100; ++copy) {
        places.emplace_back(places[7] * (1.0 + 2e-16 * (copy % 3)));
        expected.push_back(7);
    }
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

TEST(FirstAtPlace, DistinguishesPointsOfAnAxisAlignedPlane)
{
    std::vector<Vector3d> places;
    Numbers expected;
    for (std::uint32_t i = 0; i < 20'000; ++i) { // more than are compared at one coordinate
        places.emplace_back(0.5, i / 200, i % 200);
        expected.push_back(i);
    }
    places.emplace_back(0.5, 99.0, 7.0);
    expected.push_back(99 * 200 + 7);
    EXPECT_EQ(first_at_place(places, all_of(places.size())), expected);
}

// The memory of reading, filtering and sorting, beside the points. A machine must process any model
// whose points just fit in its memory.

#ifndef VCARVE_SANITIZED // sanitizers use additional memory

constexpr std::size_t kPoints = 1'000'000;
constexpr double kPerPoint = static_cast<double>(kPoints);

double memory_of_reading(const Scene& scene)
{
    const TemporaryFolder folder;
    bench::write_colmap_model(folder / "model", scene);
    Scene read;
    const double taken =
        memory_taken([&] { read = read_colmap_model(folder / "model", ModelFormat::binary); });
    EXPECT_EQ(read.num_points(), scene.num_points());
    return taken;
}

TEST(PointsMemory, ReadingNeedsAtMostAFifthMoreThanTheScene)
{
    // This number of rays would just have doubled an array that began with three per point
    Scene scene = many_points(1'050'000);
    EXPECT_LT(memory_of_reading(scene), 1.1 * bytes_of_points(scene))
        << "the file is unmapped, tracks do not grow, ascending ids are not sorted";
    std::ranges::reverse(scene.point_ids);
    EXPECT_LT(memory_of_reading(scene), 1.2 * bytes_of_points(scene));
}

TEST(PointsMemory, CenteringNeedsOneCoordinatePerPoint)
{
    Scene scene = many_points(kPoints);
    EXPECT_LT(memory_taken([&] { scene = center_points(std::move(scene)); }), 10.0 * kPerPoint);
}

TEST(PointsMemory, FilteringNeedsNoSecondScene)
{
    Scene scene = many_points(kPoints);
    FilteredPoints filtered;
    EXPECT_LT(memory_taken([&] { filtered = filter_points(std::move(scene), {}); }),
              44.0 * kPerPoint);
    EXPECT_EQ(filtered.scene.num_points(), kPoints);
}

TEST(PointsMemory, SortingNeedsNoSecondScene)
{
    Scene scene = many_points(kPoints);
    EXPECT_LT(memory_taken([&] { scene = spatial_sort(std::move(scene)); }), 44.0 * kPerPoint);
    EXPECT_EQ(scene.num_points(), kPoints);
}

TEST(PointsMemory, CroppingNeedsNoSecondScene)
{
    Scene scene = many_points(kPoints);
    const auto region = box_region({-9, -9, -9}, {9, 9, 9});
    CroppedPoints cropped;
    EXPECT_LT(memory_taken([&] { cropped = crop_points(std::move(scene), *region); }),
              44.0 * kPerPoint);
    EXPECT_EQ(cropped.inside, static_cast<std::int64_t>(kPoints));
}

#endif

} // namespace
} // namespace vcarve::filter_test
