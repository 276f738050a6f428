#include "compare/image_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve {
namespace {

Camera pinhole()
{
    return {.id = 1, .model = 1, .width_px = 200, .height_px = 100, .params = {100, 50, 100, 50}};
}

TEST(ImageField, EndsWhereAPinholeImageEnds)
{
    // u = 100 x / z + 100, v = 50 y / z + 50.
    EXPECT_TRUE(image_shows(pinhole(), {0, 0, 1}));
    EXPECT_TRUE(image_shows(pinhole(), {1.99, -1.99, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {2.01, 0, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {0, -2.01, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {0, 0, -1}));
    EXPECT_FALSE(image_shows(pinhole(), {0, 0, 0}));
}

TEST(ImageField, TakesOneFocalLengthForBothAxesWhereTheModelHasOne)
{
    const Camera simple = {
        .id = 1, .model = 0, .width_px = 200, .height_px = 100, .params = {50, 100, 50}};
    EXPECT_TRUE(image_shows(simple, {1.99, 0.99, 1}));
    EXPECT_FALSE(image_shows(simple, {2.01, 0, 1}));
    EXPECT_FALSE(image_shows(simple, {0, 1.01, 1}));
}

TEST(ImageField, IsATenthLargerWhereTheLensDistorts)
{
    const Camera radial = {
        .id = 1, .model = 2, .width_px = 200, .height_px = 100, .params = {100, 100, 50, 0.1}};
    EXPECT_TRUE(image_shows(radial, {1.19, 0, 1}));
    EXPECT_FALSE(image_shows(radial, {1.21, 0, 1}));
}

TEST(ImageField, FollowsTheAngleOfAFisheye)
{
    const Camera fisheye = {.id = 1,
                            .model = 5,
                            .width_px = 200,
                            .height_px = 200,
                            .params = {60, 60, 100, 100, 0, 0, 0, 0}};
    // The image and its margin end at 120 px of 60 px a radian: 2 radians.
    EXPECT_TRUE(image_shows(fisheye, {std::sin(1.99), 0, std::cos(1.99)}));
    EXPECT_FALSE(image_shows(fisheye, {std::sin(2.01), 0, std::cos(2.01)}));
    EXPECT_TRUE(image_shows(fisheye, {0, 0, 1}));
}

TEST(ImageField, OfAnUnknownLensIsAllThatLiesBefore)
{
    const Camera unknown = {.id = 1, .model = 99, .width_px = 9, .height_px = 9, .params = {1, 2}};
    EXPECT_TRUE(image_shows(unknown, {1e6, 0, 1}));
    EXPECT_FALSE(image_shows(unknown, {0, 0, -1}));
    Camera sizeless = pinhole();
    sizeless.width_px = 0;
    EXPECT_TRUE(image_shows(sizeless, {1e6, 0, 1}));
}

TEST(ImageField, TurnsAndMovesWithTheView)
{
    View view;
    view.center = {10, 0, 0};
    // A quarter turn about y: the camera looks along -x.
    view.cam_from_world = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY());
    EXPECT_TRUE(view_shows(view, pinhole(), {0, 0, 0}));
    EXPECT_FALSE(view_shows(view, pinhole(), {20, 0, 0}));
    EXPECT_FALSE(view_shows(view, pinhole(), {10, 0, 5}));
}

} // namespace
} // namespace vcarve
