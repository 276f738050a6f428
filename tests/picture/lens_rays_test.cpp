#include "model/camera.h"
#include "picture/lens_rays.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::lens_rays_test {
namespace {

Camera camera_of(int model, std::vector<double> params)
{
    return {
        .id = 1, .model = model, .width_px = 1000, .height_px = 750, .params = std::move(params)};
}

TEST(LensRays, AreTheLensesOwnWithinAHundredthOfAPixel)
{
    const std::vector<Camera> cameras = {
        camera_of(0, {900, 500, 375}),                                  // SIMPLE_PINHOLE
        camera_of(3, {800, 480, 380, -0.2, 0.05}),                      // RADIAL
        camera_of(4, {800, 790, 510, 370, -0.25, 0.06, 0.002, -0.001}), // OPENCV
        camera_of(5, {400, 410, 500, 375, 0.02, -0.01, 0.003, -0.001}), // OPENCV_FISHEYE
        camera_of(17, {1000, 750}),                                     // EQUIRECTANGULAR
    };
    const Eigen::Array2i size(320, 240);
    for (const Camera& camera : cameras) {
        const LensRays rays(camera, size);
        const double focal_px = 0.32 * mean_focals_px({camera})[0];
        for (int i = 0; i < 320; i += 7) {
            const int x = i;
            const int y = (i * 31) % 240;
            const Eigen::Array2d within(0.25 + 0.5 * (i % 2), 0.75);
            const auto blended = rays.at(x, y, within);
            const Eigen::Array2d place = (Eigen::Array2d(x, y) + within) * 3.125;
            const auto exact = ray(camera, place.matrix());
            ASSERT_TRUE(blended && exact) << camera.model;
            EXPECT_NEAR(blended->norm(), 1.0, 1e-12);
            EXPECT_LT((*blended - *exact).norm() * focal_px, 0.01)
                << camera.model << ": " << x << ", " << y;
        }
    }
}

TEST(LensRays, HaveNoneWhereTheLensHasNone)
{
    // From where this distortion turns back on, there are no directions; it does so at a radius of
    // 1 / sqrt(3 * 0.5) focal lengths, which it brings to 2 / 3 of that, 0.544 or 436 px.
    const Camera camera = camera_of(2, {800, 500, 375, -0.5});
    const LensRays rays(camera, {200, 150});
    const Eigen::Array2d middle(0.5, 0.5);
    EXPECT_FALSE(rays.at(12, 75, middle));
    EXPECT_TRUE(rays.at(13, 75, middle));
    EXPECT_FALSE(rays.at(0, 0, middle));
}

} // namespace
} // namespace vcarve::lens_rays_test
