#include "model/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vcarve::lens_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

// The largest angles to the axis that lenses project, and the directions that they reject.

/// The image spans -1 to 1 of the plane at focal length 1, except for EQUIRECTANGULAR.
Camera camera_of(int model, std::vector<double> extra)
{
    std::vector<double> params{100, 100, 100, 100};
    if (lens_model(model)->num_focals == 1) params.pop_back();
    params.insert(params.end(), extra.begin(), extra.end());
    return {.id = 1, .model = model, .width_px = 200, .height_px = 200, .params = params};
}

/// The direction whose angle to the axis has this tangent.
Vector3d aside(double tangent)
{
    return {tangent, 0, 1};
}

Vector3d at_angle(double angle)
{
    return {std::sin(angle), 0, std::cos(angle)};
}

struct Turn {
    const char* what;
    Camera camera;
    Vector3d before;
    Vector3d beyond;
};

const std::vector<Turn> kTurns{
    // 1 - 3 * 0.25 r^2 = 0 at r = 1.1547
    {"k < 0", camera_of(2, {-0.25}), aside(1.15), aside(1.16)},
    {"k < 0, far beyond", camera_of(2, {-0.25}), aside(1.15), aside(1e3)},
    {"k < 0, fisheye", camera_of(8, {-0.25}), at_angle(1.15), at_angle(1.16)},
    // 1 - 1.5 s + 0.3 s^2 = 0 at s = 0.7923 and 4.2077: the radius decreases only in between
    {"k1 < 0 < k2", camera_of(3, {-0.5, 0.06}), aside(0.889), aside(0.891)},
    {"k1 < 0 < k2, risen again", camera_of(3, {-0.5, 0.06}), aside(0.889), aside(3)},
    {"k1 < 0 < k2, fisheye", camera_of(9, {-0.5, 0.06}), at_angle(0.889), at_angle(2.5)},
    // 1 - 0.28 s^3 = 0 at s = 1.5286, 1 - 0.36 s^4 = 0 at s = 1.2910
    {"k3 < 0", camera_of(19, {0, 0, -0.04, 0, 0}), aside(1.236), aside(1.237)},
    {"k4 < 0", camera_of(5, {0, 0, 0, -0.04}), at_angle(1.136), at_angle(1.137)},
    // 1 + 6 p2 x = 0 at x = 3.333, 1 + 6 p x = 0 at 1.667
    {"p2 < 0", camera_of(4, {0, 0, 0, -0.05}), aside(3.33), aside(3.34)},
    {"p2 < 0, in the image", camera_of(4, {0, 0, 0, -0.05}), aside(3.33), aside(6.5)},
    {"p0 < 0", camera_of(11, {0, 0, 0, 0, 0, 0, -0.1, 0, 0, 0, 0, 0}), at_angle(1.66),
     at_angle(1.68)},
    // 1 + 2 sx1 x = 0 at 2.5, 1 + 4 s1 x^3 = 0 at 1.71
    {"sx1 < 0", camera_of(10, {0, 0, 0, 0, 0, 0, -0.2, 0}), at_angle(2.49), at_angle(2.51)},
    {"s1 < 0", camera_of(11, {0, 0, 0, 0, 0, 0, 0, 0, 0, -0.05, 0, 0}), at_angle(1.70),
     at_angle(1.72)},
    {"k0 < 0, in sequence", camera_of(11, {-0.25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), at_angle(1.15),
     at_angle(1.16)},
    // r / D increases while D - 2 s D' > 0: 1 - 0.5 s for k4 = 0.5, and 1 + 0.25 s for k4 = -0.25,
    // where D = 0 at r = 2.
    {"k4 > 0", camera_of(6, {0, 0, 0, 0, 0, 0.5, 0, 0}), aside(1.41), aside(1.42)},
    {"k4 < 0", camera_of(6, {0, 0, 0, 0, 0, -0.25, 0, 0}), aside(1.99), aside(2.01)},
    // 1 + 0.25 x^2 - 6 x (1 - 0.25 x^2)^2 = 0 at x = 0.1703
    {"p2 < 0 over k4", camera_of(6, {0, 0, 0, -1, 0, -0.25, 0, 0}), aside(0.1702), aside(0.1705)},
    // 1 - 4 k r^2 = 0 at r = 1
    {"division", camera_of(13, {0.25}), aside(0.999), aside(1.001)},
    // z > -d (1 - 0.75) / 0.75 up to 109.47 degrees, z > -d 0.2 / (1 - 0.2) up to 104.48
    {"unified, alpha > 1 / 2", camera_of(16, {0.75, 1}), at_angle(109.4 * pi / 180),
     at_angle(109.5 * pi / 180)},
    {"unified, alpha < 1 / 2", camera_of(16, {0.2, 1}), at_angle(104.4 * pi / 180),
     at_angle(104.5 * pi / 180)},
};

TEST(CameraReach, EndsWhereTheDistortionTurns)
{
    for (const Turn& turn : kTurns) {
        EXPECT_TRUE(project(turn.camera, turn.before)) << turn.what;
        EXPECT_FALSE(project(turn.camera, turn.beyond)) << turn.what;
        EXPECT_FALSE(image_shows(turn.camera, turn.beyond)) << turn.what;
    }
}

TEST(CameraReach, ExcludesPointsThatAPolynomialMapsBackIntoTheImage)
{
    // 1.9 (1 - 0.25 * 1.9^2) = 0.185 and 2.1 (1 - 0.25 * 2.1^2) = -0.215 of 1.
    const Camera radial = camera_of(2, {-0.25});
    EXPECT_FALSE(image_shows(radial, aside(1.9)));
    EXPECT_FALSE(image_shows(radial, aside(2.1)));
    EXPECT_TRUE(image_shows(radial, aside(0.185)));
    // 6.5 - 3 * 0.05 * 6.5^2 = 0.1625
    EXPECT_FALSE(image_shows(camera_of(4, {0, 0, 0, -0.05}), aside(6.5)));
    // 1.7 / (1 - 1.7^2) = -0.899
    EXPECT_FALSE(image_shows(camera_of(6, {0, 0, 0, 0, 0, -1, 0, 0}), aside(1.7)));
}

TEST(CameraReach, IsUnlimitedIfAPolynomialNeverTurns)
{
    // The minimum of 1 - 0.9 s + 0.5 s^2 is 0.595, at s = 0.9.
    const Camera radial = camera_of(3, {-0.3, 0.1});
    const auto x_px = project(radial, aside(10));
    ASSERT_TRUE(x_px);
    EXPECT_NEAR(x_px->x(), 100 * 10 * (1 - 30 + 1000) + 100, 1e-6);
    // The minimum of 1 - 2 s + 1.05 s^2 is 0.048, that of 1 - 2 s + 0.999 s^2 is -0.001.
    EXPECT_TRUE(project(camera_of(3, {-2.0 / 3, 0.21}), aside(1.5)));
    EXPECT_FALSE(project(camera_of(3, {-2.0 / 3, 0.1998}), aside(1.5)));
}

TEST(CameraReach, ExcludesOnlyTheBackwardAxisOfAFisheye)
{
    const Camera fisheye = camera_of(15, {});
    EXPECT_TRUE(project(fisheye, at_angle(3.1)));
    EXPECT_EQ(project(fisheye, {0, 0, 2}), Vector2d(100, 100));
    EXPECT_FALSE(project(fisheye, {0, 0, -1}));
    EXPECT_FALSE(project(fisheye, {0, 0, 0}));
    EXPECT_TRUE(ray(fisheye, {100 + 314.1, 100}));
    EXPECT_FALSE(ray(fisheye, {100 + 314.2, 100}));
}

TEST(CameraReach, EndsBesideAPerspectiveLens)
{
    const std::vector<Camera> perspective{
        camera_of(0, {}),           camera_of(1, {}),
        camera_of(2, {0.1}),        camera_of(3, {0.1, 0}),
        camera_of(4, {0, 0, 0, 0}), camera_of(6, {0, 0, 0, 0, 0, 0, 0, 0}),
        camera_of(7, {0.9}),        camera_of(12, {0.1}),
        camera_of(18, {1}),         camera_of(19, {0, 0, 0, 0, 0}),
    };
    for (const Camera& camera : perspective) {
        EXPECT_TRUE(project(camera, {0.1, 0.1, 0.5})) << camera.model;
        EXPECT_FALSE(project(camera, {0.1, 0.1, 0})) << camera.model;
        EXPECT_FALSE(project(camera, {0.1, 0.1, -1})) << camera.model;
        EXPECT_FALSE(project(camera, {0, 0, -1})) << camera.model;
        EXPECT_FALSE(project(camera, {0, 0, 0})) << camera.model;
    }
}

TEST(CameraReach, HasNoRayForPixelsThatShowNothing)
{
    // For k = -0.25 the image ends at 2 / 3 of 1.1547: 76.98 px from the center.
    EXPECT_TRUE(ray(camera_of(2, {-0.25}), {100 + 76.9, 100}));
    EXPECT_FALSE(ray(camera_of(2, {-0.25}), {100 + 77.1, 100}));
    // Ends where the radius times omega is pi / 2: 157.08 px.
    EXPECT_TRUE(ray(camera_of(7, {1}), {100 + 157, 100}));
    EXPECT_FALSE(ray(camera_of(7, {1}), {100 + 157.1, 100}));
    // Ends at 1 / sqrt(k): 200 px.
    EXPECT_TRUE(ray(camera_of(13, {0.25}), {100 + 199, 100}));
    EXPECT_FALSE(ray(camera_of(13, {0.25}), {100 + 201, 100}));
    // Ends at 1 / sqrt(2 alpha - 1) for beta = 1: 141.4 px.
    EXPECT_TRUE(ray(camera_of(16, {0.75, 1}), {100 + 141, 100}));
    EXPECT_FALSE(ray(camera_of(16, {0.75, 1}), {100 + 142, 100}));
}

TEST(CameraReach, IncludesAllDirectionsOfAPanorama)
{
    const Camera panorama = {
        .id = 1, .model = 17, .width_px = 400, .height_px = 200, .params = {400, 200}};
    EXPECT_TRUE(image_shows(panorama, {0, 0, -1}));
    EXPECT_TRUE(image_shows(panorama, {0, -1, 0}));
    EXPECT_FALSE(image_shows(panorama, {0, 0, 0}));
    EXPECT_TRUE(ray(panorama, {400, 200}));
    EXPECT_FALSE(ray(panorama, {400.1, 100}));
    EXPECT_FALSE(ray(panorama, {100, -0.1}));
}

TEST(CameraReach, MatchesPinholeForZeroFieldOfView)
{
    EXPECT_EQ(project(camera_of(7, {0}), aside(0.5)), Vector2d(150, 100));
    EXPECT_EQ(ray(camera_of(7, {0}), {150, 100}), aside(0.5).normalized());
    EXPECT_NEAR(project(camera_of(7, {1e-6}), aside(0.5))->x(), 150, 1e-9);
    EXPECT_FALSE(project(camera_of(7, {3.2}), aside(0.5)));
}

TEST(CameraReach, IsEmptyForUnknownLensesAndNaN)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Camera unknown = camera_of(1, {});
    unknown.model = -1;
    Camera incomplete = camera_of(4, {0, 0, 0});
    for (const Camera& camera : {unknown, incomplete}) {
        EXPECT_FALSE(project(camera, {0, 0, 1}));
        EXPECT_FALSE(ray(camera, {100, 100}));
    }
    for (int model = 0; lens_model(model) != nullptr; ++model) {
        const Camera camera = camera_of(model, std::vector<double>(12, 0.01));
        EXPECT_TRUE(project(camera, {0.1, 0.1, 1})) << model;
        EXPECT_FALSE(project(camera, {nan, 0.1, 1})) << model;
        EXPECT_FALSE(project(camera, {0.1, 0.1, nan})) << model;
        EXPECT_FALSE(image_shows(camera, {0.1, nan, 1})) << model;
        EXPECT_FALSE(ray(camera, {nan, 0.1})) << model;
    }
}

} // namespace
} // namespace vcarve::lens_test
