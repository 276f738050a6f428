#include "steps/1_points/arrange.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace vcarve::arrange_test {
namespace {

using Eigen::Vector3d;

TEST(CenterPoints, MovesTheMedianToTheOriginAndRecordsTheOffset)
{
    const Scene scene = make_scene(
        {{500010, 0, 0}}, {{{500000, 1, 0}, {0}}, {{500002, 2, 0}, {0}}, {{900000, 3, 0}, {0}}});
    const Scene centered = center_points(scene);
    EXPECT_EQ(centered.offset, Vector3d(500002, 2, 0));
    EXPECT_EQ(centered.positions, (std::vector<Vector3d>{{-2, -1, 0}, {0, 0, 0}, {399998, 1, 0}}));
    EXPECT_EQ(centered.views[0].center, Vector3d(8, -2, 0));
}

TEST(CenterPoints, IgnoresNonFiniteCoordinates)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Scene scene = make_scene({{0, 0, 0}}, {{{nan, 5, 5}, {0}}, {{3, 5, 5}, {0}}});
    EXPECT_EQ(center_points(scene).offset, Vector3d(3, 5, 5));
}

TEST(SpatialSortPoints, DoesNotDependOnTheInputOrder)
{
    const Scene scene = bumpy_sphere(2000, 11);
    const Scene sorted = spatial_sort(scene);
    EXPECT_EQ(sorted.positions, spatial_sort(permuted(scene, 3)).positions);
    EXPECT_EQ(sorted.point_ids, spatial_sort(permuted(scene, 4)).point_ids);
}

TEST(SpatialSortPoints, MovesAllAttributesOfAPointTogether)
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

} // namespace
} // namespace vcarve::arrange_test
