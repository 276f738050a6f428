#include "steps/1_points/filter.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Filter, DropsEachBadPointForItsOwnReason)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}},   // good
                                        {{nan, 0, 0}, {0, 1}}, // not finite
                                        {{2, 0, 0}, {0}},      // one view
                                        {{3, 0, 0}, {0, 1}},   // error, see below
                                        {{4, 0, 0}, {0, 2}}}); // 0.06 degrees between its sights
    scene.errors_px[3] = 4.5;
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.non_finite, 1);
    EXPECT_EQ(result.report.few_views, 1);
    EXPECT_EQ(result.report.high_error, 1);
    EXPECT_EQ(result.report.low_angle, 1);
    EXPECT_EQ(result.report.duplicate, 0);
}

TEST(Filter, DropsPointsBeyondAllPlaces)
{
    const Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}},
                                              {{1e160, 0, 0}, {0, 1}},
                                              {{0, -1e300, 0}, {0, 1}},
                                              {{0, 0, 1.1e100}, {0, 1}}});
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.non_finite, 3);
}

TEST(Filter, AsksForAnAngleOnlyOfPointsThatWereTriangulated)
{
    const Scene scene = make_scene(kCenters, {{{1, 0, 0}, {1}}, {{4, 0, 0}, {0, 2}}});
    const FilteredPoints result = filter_points(scene, {.min_views = 1});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(result.report.low_angle, 1);
}

TEST(Filter, KeepsTheViewsOfAllPointsAtAPlaceBehindOthersThatAreDropped)
{
    const Scene scene = make_scene(kCenters, {{{2, 0, 0}, {0}},      // one view
                                              {{1, 0, 0}, {0, 1}},   // at one place
                                              {{1, 0, 0}, {1, 2}},   // with this
                                              {{4, 0, 0}, {0, 2}},   // 0.06 degrees
                                              {{3, 0, 0}, {0, 1}}}); // good
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{2, 5}));
    EXPECT_EQ(result.scene.tracks.begins, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(result.scene.tracks.views, (std::vector<std::uint32_t>{0, 1, 2, 0, 1}));
    EXPECT_EQ(result.scene.positions, (std::vector<Vector3d>{{1, 0, 0}, {3, 0, 0}}));
}

TEST(Filter, AsksForNoSecondViewWhereTheRangeWasMeasured)
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

TEST(Filter, DropsNothingButNonFinitePointsWhenSwitchedOff)
{
    Scene scene =
        make_scene(kCenters, {{{2, 0, 0}, {0}}, {{3, 0, 0}, {0, 1}}, {{4, 0, 0}, {0, 2}}});
    scene.errors_px[1] = 1e9;
    EXPECT_EQ(filter_points(scene, all_off()).scene.num_points(), 3U);
}

TEST(Filter, KeepsPointsOfUnknownError)
{
    Scene scene = make_scene(kCenters, {{{1, 0, 0}, {0, 1}}});
    scene.errors_px[0] = -1.0;
    EXPECT_EQ(filter_points(scene, {}).scene.num_points(), 1U);
}

TEST(Filter, MergesPointsAtOnePlaceAndUnitesTheirViews)
{
    Scene scene = make_scene(
        kCenters,
        {{{1, 0, 0}, {0}}, {{7, 7, 7}, {0, 1}}, {{1, 0, 0}, {1, 2}}, {{1, 0, 0}, {0, 2}}});
    scene.errors_px[3] = 0.25; // as many views as the third, smaller error: the best
    const FilteredPoints result = filter_points(scene, {});
    EXPECT_EQ(result.report.duplicate, 2);
    EXPECT_EQ(result.scene.point_ids, (std::vector<std::uint64_t>{2, 4}));
    EXPECT_EQ(result.scene.colors[1], scene.colors[3]);
    EXPECT_EQ(result.scene.errors_px[1], 0.25);
    EXPECT_EQ(result.scene.tracks.views, (std::vector<std::uint32_t>{0, 1, 0, 1, 2}));
}

TEST(Filter, JudgesTheAngleByTheWidestPairOfSights)
{
    // Seen at 0.06 degrees by views 0 and 2 and at about 22 degrees by view 1.
    const Scene scene = make_scene(kCenters, {{{0, 0, 0}, {0, 1, 2}}});
    FilterOptions options;
    options.min_angle_deg = 21.0;
    EXPECT_EQ(filter_points(scene, options).scene.num_points(), 1U);
    options.min_angle_deg = 23.0;
    EXPECT_EQ(filter_points(scene, options).scene.num_points(), 0U);
}

TEST(Filter, KeepsTheNormalsOfThePointsItKeeps)
{
    Scene scene =
        make_scene(kCenters, {{{1, 0, 0}, {0, 1}}, {{2, 0, 0}, {0}}, {{3, 0, 0}, {0, 1}}});
    EXPECT_TRUE(filter_points(scene, {}).scene.normals.empty());
    scene.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(filter_points(scene, {}).scene.normals,
              (std::vector<Eigen::Vector3f>{{1, 0, 0}, {0, 0, 1}}));
}

} // namespace
} // namespace vcarve::filter_test
