#include "stereo/fuse.h"

#include <gtest/gtest.h>

namespace vcarve::fuse_test {
namespace {

using Eigen::Vector3d;
using Views = std::vector<std::uint32_t>;

/// Three cameras side by side and their depth maps of the plane z = 2. Their baselines are whole
/// pixels at this depth.
struct ThreeMaps {
    Scene scene;
    std::vector<StereoView> views;
    std::vector<DepthMap> maps;
    std::vector<Views> neighbors = {{1, 2}, {0, 2}, {0, 1}};

    ThreeMaps()
    {
        scene.offset = Vector3d(7.0, 0.0, 0.0);
        for (std::uint32_t i = 0; i < 3; ++i) {
            StereoView view;
            view.view = i;
            view.center = Vector3d(0.2 * i, 0.0, 0.0);
            view.camera = {20.0F, {9.0F, 9.0F}};
            view.image = {20, 20, {}};
            view.colors.assign(100, {static_cast<std::uint8_t>(i), 0, 0});
            views.push_back(view);
            DepthMap map{10, 10, std::vector<PixelPlane>(100), std::vector<float>(100, 0.1F)};
            for (PixelPlane& plane : map.planes) {
                plane.depth = 2.0F;
            }
            maps.push_back(map);
            scene.views.emplace_back();
        }
    }

    Scene fused() const { return fuse(scene, {views, maps, neighbors}, {}); }
};

TEST(Fuse, MakesOnePointOfPixelsThatThreeMapsAgreeOn)
{
    // A baseline of 0.2 shifts the plane by one of ten pixels of a depth map, so both other maps
    // show eight columns of the first map.
    const Scene fused = ThreeMaps().fused();
    ASSERT_EQ(fused.num_points(), 80U);
    EXPECT_TRUE(fused.is_dense);
    EXPECT_EQ(fused.offset, Vector3d(7.0, 0.0, 0.0));
    for (std::size_t i = 0; i < fused.num_points(); ++i) {
        EXPECT_NEAR(fused.positions[i].z(), 2.0, 1e-6);
        EXPECT_EQ(Views(fused.tracks[i].begin(), fused.tracks[i].end()), (Views{0, 1, 2}));
        EXPECT_EQ(fused.normals[i], Eigen::Vector3f(0.0F, 0.0F, -1.0F));
        EXPECT_EQ(fused.colors[i], Color());
    }
}

TEST(Fuse, AveragesAgreeingPixels)
{
    ThreeMaps input;
    for (PixelPlane& plane : input.maps[1].planes) {
        plane.depth = 2.006F;
    }
    const Scene fused = input.fused();
    ASSERT_GT(fused.num_points(), 0U);
    EXPECT_NEAR(fused.positions[0].z(), 2.002, 1e-6);
}

TEST(Fuse, RequiresThreeMaps)
{
    ThreeMaps input;
    for (PixelPlane& plane : input.maps[1].planes) {
        plane.depth = 2.5F;
    }
    EXPECT_EQ(input.fused().num_points(), 0U);
}

TEST(Fuse, RequiresNormalsToAgree)
{
    ThreeMaps input;
    for (PixelPlane& plane : input.maps[1].planes) {
        plane.normal = Eigen::Vector3f(0.0F, -0.6F, -0.8F);
    }
    EXPECT_EQ(input.fused().num_points(), 0U);
}

TEST(Fuse, IgnoresUnmeasuredPixels)
{
    ThreeMaps input;
    input.maps[0].costs.assign(100, DepthMap::kNoCost);
    EXPECT_EQ(input.fused().num_points(), 0U);
}

} // namespace
} // namespace vcarve::fuse_test
