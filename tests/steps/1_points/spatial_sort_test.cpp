#include "steps/1_points/spatial_sort.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve::spatial_sort_test {
namespace {

using Eigen::Vector3d;

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

} // namespace
} // namespace vcarve::spatial_sort_test
