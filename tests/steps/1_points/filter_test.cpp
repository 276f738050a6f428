#include "steps/1_points/center.h"
#include "steps/1_points/filter.h"
#include "steps/1_points/spatial_sort.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace vcarve {
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

TEST(CenterPoints, MovesTheMedianToTheOriginAndRecordsTheMove)
{
    const Scene scene = make_scene(
        {{500010, 0, 0}}, {{{500000, 1, 0}, {0}}, {{500002, 2, 0}, {0}}, {{900000, 3, 0}, {0}}});
    const Scene centered = center_points(scene);
    EXPECT_EQ(centered.offset, Vector3d(500002, 2, 0));
    EXPECT_EQ(centered.positions, (std::vector<Vector3d>{{-2, -1, 0}, {0, 0, 0}, {399998, 1, 0}}));
    EXPECT_EQ(centered.views[0].center, Vector3d(8, -2, 0));
}

TEST(CenterPoints, IgnoresCoordinatesThatAreNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Scene scene = make_scene({{0, 0, 0}}, {{{nan, 5, 5}, {0}}, {{3, 5, 5}, {0}}});
    EXPECT_EQ(center_points(scene).offset, Vector3d(3, 5, 5));
}

TEST(SpatialSortPoints, GivesOneOrderForAnyOrderOfTheInput)
{
    const Scene scene = bumpy_sphere(2000, 11);
    const Scene sorted = spatial_sort(scene);
    EXPECT_EQ(sorted.positions, spatial_sort(permuted(scene, 3)).positions);
    EXPECT_EQ(sorted.point_ids, spatial_sort(permuted(scene, 4)).point_ids);
}

TEST(SpatialSortPoints, KeepsWhatBelongsToAPointTogether)
{
    Scene scene = bumpy_sphere(500, 12);
    for (const Vector3d& position : scene.positions) {
        scene.normals.emplace_back(position.cast<float>());
    }
    const Scene sorted = spatial_sort(scene);
    ASSERT_EQ(sorted.num_points(), scene.num_points());
    for (std::size_t i = 0; i < sorted.num_points(); ++i) {
        const std::size_t from = sorted.point_ids[i] - 1;
        ASSERT_EQ(sorted.positions[i], scene.positions[from]);
        ASSERT_EQ(sorted.colors[i], scene.colors[from]);
        ASSERT_EQ(sorted.errors_px[i], scene.errors_px[from]);
        ASSERT_EQ(sorted.normals[i], scene.normals[from]);
        const auto row = sorted.tracks[i];
        const auto expected = scene.tracks[from];
        ASSERT_TRUE(std::equal(row.begin(), row.end(), expected.begin(), expected.end()));
    }
}

TEST(SpatialSortPoints, PutsNeighboursNextToEachOther)
{
    const Scene scene = bumpy_sphere(4000, 13);
    const auto way = [](const Scene& s) {
        double length = 0.0;
        for (std::size_t i = 1; i < s.num_points(); ++i) {
            length += (s.positions[i] - s.positions[i - 1]).norm();
        }
        return length;
    };
    EXPECT_LT(way(spatial_sort(scene)), 0.2 * way(scene));
}

} // namespace
} // namespace vcarve
