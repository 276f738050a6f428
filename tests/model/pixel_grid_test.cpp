#include "model/pixel_grid.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::pixel_grid_test {
namespace {

TEST(PixelGrid, IsOfAboutSquareCells)
{
    Camera camera;
    camera.width_px = 400;
    camera.height_px = 200;
    const std::vector<Eigen::Vector2d> pixels = pixel_grid(camera, 8);
    const std::vector<Eigen::Vector2d> expected = {{50, 50},  {150, 50},  {250, 50},  {350, 50},
                                                   {50, 150}, {150, 150}, {250, 150}, {350, 150}};
    EXPECT_EQ(pixels, expected);
    EXPECT_EQ(pixel_grid(camera, 1).size(), 1U);
    camera.height_px = 0;
    EXPECT_TRUE(pixel_grid(camera, 8).empty());
}

} // namespace
} // namespace vcarve::pixel_grid_test
