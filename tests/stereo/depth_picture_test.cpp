#include "stereo/depth_picture.h"
#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"

#include <gtest/gtest.h>

namespace vcarve::depth_picture_test {
namespace {

/// A row of pixels with these depths; 0: not measured.
DepthMap row_of(const std::vector<float>& depths)
{
    DepthMap map;
    map.width_px = static_cast<int>(depths.size());
    map.height_px = 1;
    for (const float depth : depths) {
        PixelPlane plane;
        plane.depth = depth;
        map.planes.push_back(plane);
        map.costs.push_back(depth > 0.0F ? 0.1F : DepthMap::kNoCost);
    }
    return map;
}

TEST(DepthPicture, IsLightForNearSurfaces)
{
    StereoView view;
    view.view = 7;
    view.colors = {{10, 20, 30}, {}, {}, {}};
    const DepthPicture picture = depth_picture(view, row_of({1.0F, 2.0F, 4.0F, 0.0F}));
    EXPECT_EQ(picture.view, 7U);
    EXPECT_EQ(picture.photograph.rgb[1], 20);
    // Inverse depths 1, 1/2 and 1/4: white, a third between, and the darkest gray.
    EXPECT_EQ(picture.depth.rgb,
              (std::vector<std::uint8_t>{255, 255, 255, 105, 105, 105, 30, 30, 30, 40, 50, 110}));
}

TEST(DepthPicture, ShowsNoDepthForAnEmptyMap)
{
    StereoView view;
    view.colors = {{}, {}};
    EXPECT_EQ(depth_picture(view, row_of({0.0F, 0.0F})).depth.rgb,
              (std::vector<std::uint8_t>{40, 50, 110, 40, 50, 110}));
}

TEST(Fullest, ReturnsTheMapWithTheMostMeasuredPixels)
{
    EXPECT_EQ(fullest({row_of({0.0F, 1.0F}), row_of({1.0F, 1.0F}), row_of({2.0F, 2.0F})}), 1U);
    EXPECT_EQ(fullest({}), 0U);
}

} // namespace
} // namespace vcarve::depth_picture_test
