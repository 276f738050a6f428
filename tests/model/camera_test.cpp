#include "model/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vcarve::camera_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

Camera camera_of(int model, std::vector<double> params)
{
    return {
        .id = 1, .model = model, .width_px = 640, .height_px = 480, .params = std::move(params)};
}

/// The direction at an angle to the axis, towards (3, 4) in the image plane.
Vector3d direction(double angle)
{
    return {0.6 * std::sin(angle), 0.8 * std::sin(angle), std::cos(angle)};
}

// ---- the table ----------------------------------------------------------------------------------

struct Listed {
    const char* name;
    std::size_t num_params;
    std::size_t num_focals;
};

const std::vector<Listed> kListed{
    {"SIMPLE_PINHOLE", 3, 1},
    {"PINHOLE", 4, 2},
    {"SIMPLE_RADIAL", 4, 1},
    {"RADIAL", 5, 1},
    {"OPENCV", 8, 2},
    {"OPENCV_FISHEYE", 8, 2},
    {"FULL_OPENCV", 12, 2},
    {"FOV", 5, 2},
    {"SIMPLE_RADIAL_FISHEYE", 4, 1},
    {"RADIAL_FISHEYE", 5, 1},
    {"THIN_PRISM_FISHEYE", 12, 2},
    {"RAD_TAN_THIN_PRISM_FISHEYE", 16, 2},
    {"SIMPLE_DIVISION", 4, 1},
    {"DIVISION", 5, 2},
    {"SIMPLE_FISHEYE", 3, 1},
    {"FISHEYE", 4, 2},
    {"EUCM", 6, 2},
    {"EQUIRECTANGULAR", 2, 0},
    {"SKEWED_PINHOLE", 5, 2},
    {"BROWN_CONRADY", 8, 1},
};

TEST(LensModel, IsFoundByNumberAndByName)
{
    for (std::size_t i = 0; i < kListed.size(); ++i) {
        const LensModel* lens = lens_model(static_cast<int>(i));
        ASSERT_NE(lens, nullptr) << i;
        EXPECT_EQ(lens->name, kListed[i].name);
        EXPECT_EQ(lens->number, static_cast<int>(i));
        EXPECT_EQ(lens->num_params, kListed[i].num_params) << lens->name;
        EXPECT_EQ(lens->num_focals, kListed[i].num_focals) << lens->name;
        EXPECT_EQ(lens_model(lens->name), lens);
    }
    EXPECT_EQ(lens_model(-1), nullptr);
    EXPECT_EQ(lens_model(static_cast<int>(kListed.size())), nullptr);
    EXPECT_EQ(lens_model("PIN"), nullptr);
    EXPECT_EQ(lens_model(""), nullptr);
}

TEST(LensModel, HasIntrinsics)
{
    const auto one = intrinsics(camera_of(3, {100, 50, 40, 0.5, 0.25}));
    ASSERT_TRUE(one);
    EXPECT_EQ(one->focal_px, Vector2d(100, 100));
    EXPECT_EQ(one->principal_px, Vector2d(50, 40));
    EXPECT_EQ(one->skew_px, 0.0);
    const auto two = intrinsics(camera_of(18, {100, 200, 50, 40, 10}));
    ASSERT_TRUE(two);
    EXPECT_EQ(two->focal_px, Vector2d(100, 200));
    EXPECT_EQ(two->principal_px, Vector2d(50, 40));
    EXPECT_EQ(two->skew_px, 10.0);
    EXPECT_FALSE(intrinsics(camera_of(17, {640, 480})));
    EXPECT_FALSE(intrinsics(camera_of(1, {100, 100, 50})));
    EXPECT_FALSE(intrinsics(camera_of(-1, {100, 100, 50, 40})));
}

TEST(MeanFocals, AreMeansOrTheLargerSideOfTheImage)
{
    const Camera simple = {.model = 0, .width_px = 8, .height_px = 6, .params = {100, 4, 3}};
    const Camera pinhole = {.model = 1, .width_px = 8, .height_px = 6, .params = {100, 200, 4, 3}};
    const Camera unknown = {.model = -1, .width_px = 80, .height_px = 60, .params = {}};
    EXPECT_EQ(mean_focals_px({simple, pinhole, unknown}), (std::vector<double>{100, 150, 80}));
    const Camera panorama{.model = 17, .width_px = 400, .height_px = 200, .params = {400, 200}};
    EXPECT_EQ(mean_focals_px({panorama})[0], 400 / (2.0 * std::numbers::pi));
}

// ---- computed by hand ---------------------------------------------------------------------------

struct ByHand {
    int model;
    std::vector<double> params;
    Vector3d x;
    Vector2d x_px;
};

/// Most use the point (1.2, 1.6) of the plane, so s = 4, s^2 = 16, ...: (1.2, 1.6, 1) for
/// perspective lenses, an angle of 2 for fisheyes. There, p1 = 0.01 and p2 = 0.02 add (0.176,
/// 0.168).
const std::vector<ByHand> kByHand{
    {0, {100, 50, 40}, {1, 2, 4}, {75, 90}},
    {1, {100, 200, 50, 40}, {1, 2, 4}, {75, 140}},
    {18, {100, 200, 50, 40, 10}, {1.2, 1.6, 1}, {186, 360}},
    // radial factors 2, 4, 4, 6 / 2, 6
    {2, {100, 50, 40, 0.25}, {1.2, 1.6, 1}, {290, 360}},
    {3, {100, 50, 40, 0.5, 0.0625}, {2.4, 3.2, 2}, {530, 680}},
    {4, {100, 200, 50, 40, 0.5, 0.0625, 0.01, 0.02}, {1.2, 1.6, 1}, {547.6, 1353.6}},
    {6,
     {100, 200, 50, 40, 0.5, 0.0625, 0.01, 0.02, 1.0 / 32, 0.125, 1.0 / 64, 1.0 / 256},
     {1.2, 1.6, 1},
     {427.6, 1033.6}},
    {19, {100, 50, 40, 0.5, 0.0625, 1.0 / 32, 0.01, 0.02}, {1.2, 1.6, 1}, {787.6, 1016.8}},
    // radial factors 1, 1, 2, 4, 7, 7
    {14, {100, 50, 40}, direction(2), {170, 200}},
    {15, {100, 200, 50, 40}, direction(2), {170, 360}},
    {8, {100, 50, 40, 0.25}, direction(2), {290, 360}},
    {9, {100, 50, 40, 0.5, 0.0625}, direction(2), {530, 680}},
    {5, {100, 200, 50, 40, 0.5, 0.0625, 1.0 / 32, 1.0 / 256}, direction(2), {890, 2280}},
    // the prism adds (0.12, 0.2)
    {10,
     {100, 200, 50, 40, 0.5, 0.0625, 0.01, 0.02, 1.0 / 32, 1.0 / 256, 0.03, 0.05},
     direction(2),
     {919.6, 2353.6}},
    // a radial factor of 4 gives (4.8, 6.4); p adds (0.23296, 0.35328), s adds (0.10496, 0.20992)
    {11,
     {100, 200, 50, 40, 0.25, 1.0 / 32, 1.0 / 64, 1.0 / 512, -1.0 / 2048, 1.0 / 8192, //
      0.001, 0.002, 0.001, 0.00001, 0.002, 0.00002},
     direction(2),
     {563.792, 1432.64}},
    // tan(omega / 2) = 1; the radius sqrt(3) / 2 becomes (pi / 3) / (pi / 2)
    {7,
     {100, 200, 50, 40, pi / 2},
     {0.3 * std::sqrt(3.0), 0.4 * std::sqrt(3.0), 1},
     {90, 40 + 320.0 / 3}},
    // (1.2, 1.6) is the image of (1.2, 1.6, 1 + 4 k), where 1 + 4 k is 1.25, 0.5 and -1
    {12, {100, 50, 40, 0.0625}, {1.2, 1.6, 1.25}, {170, 200}},
    {13, {100, 200, 50, 40, -0.125}, {2.4, 3.2, 1}, {170, 360}},
    {13, {100, 200, 50, 40, -0.5}, {1.2, 1.6, -1}, {170, 360}},
    // d = 3, so the divisor is 0.25 * 3 + 0.75
    {16, {100, 200, 50, 40, 0.25, 2}, {1.2, 1.6, 1}, {130, 40 + 640.0 / 3}},
    {17, {400, 200}, {1, 0, 1}, {250, 100}},
    {17, {400, 200}, {0, 1, 1}, {200, 150}},
    {17, {400, 200}, {-1, -std::sqrt(2.0), -1}, {50, 50}},
};

TEST(Camera, ProjectsAsComputedByHand)
{
    for (const ByHand& hand : kByHand) {
        const auto x_px = project(camera_of(hand.model, hand.params), hand.x);
        ASSERT_TRUE(x_px) << hand.model;
        EXPECT_NEAR(x_px->x(), hand.x_px.x(), 1e-9) << hand.model;
        EXPECT_NEAR(x_px->y(), hand.x_px.y(), 1e-9) << hand.model;
    }
}

TEST(Camera, ReturnsDirectionsComputedByHand)
{
    for (const ByHand& hand : kByHand) {
        const auto found = ray(camera_of(hand.model, hand.params), hand.x_px);
        ASSERT_TRUE(found) << hand.model;
        EXPECT_LT((*found - hand.x.normalized()).norm(), 1e-9) << hand.model;
    }
}

// ---- every model over a whole image -------------------------------------------------------------

/// Typical calibrations of real cameras, for images of 640 x 480 px.
const std::vector<Camera> kReal{
    camera_of(0, {500, 322, 238}),
    camera_of(1, {500, 505, 322, 238}),
    camera_of(2, {500, 322, 238, -0.08}),
    camera_of(3, {500, 322, 238, -0.3, 0.12}),
    camera_of(4, {500, 505, 322, 238, -0.3, 0.12, 1e-3, -7e-4}),
    camera_of(5, {250, 251, 322, 238, -0.03, 0.01, -0.004, 5e-4}),
    camera_of(6, {500, 505, 322, 238, 0.4, 0.05, 1e-3, -7e-4, 0.005, 0.7, 0.1, 0.01}),
    camera_of(7, {400, 402, 322, 238, 0.92}),
    camera_of(8, {250, 322, 238, -0.03}),
    camera_of(9, {250, 322, 238, -0.03, 0.01}),
    camera_of(10, {250, 251, 322, 238, -0.03, 0.01, 1e-3, -7e-4, -0.004, 5e-4, 1e-3, -2e-3}),
    camera_of(11, {240, 240, 322, 238, -0.024, 0.098, -0.067, 0.012, 1e-3, -3e-4, //
                   -2e-4, 5e-4, 1e-3, -3e-4, 2e-4, 1e-4}),
    camera_of(12, {500, 322, 238, -0.2}),
    camera_of(13, {500, 505, 322, 238, 0.1}),
    camera_of(14, {250, 322, 238}),
    camera_of(15, {250, 251, 322, 238}),
    camera_of(16, {300, 301, 322, 238, 0.6, 1.1}),
    camera_of(17, {640, 480}),
    camera_of(18, {500, 505, 322, 238, 3}),
    camera_of(19, {500, 322, 238, -0.3, 0.12, -0.02, 1e-3, -7e-4}),
};

TEST(Camera, RoundTripsEveryPixel)
{
    ASSERT_EQ(kReal.size(), kListed.size());
    for (const Camera& camera : kReal) {
        for (int i = 0; i < 33 * 25; ++i) {
            const Vector2d x_px(20.0 * (i % 33), 20.0 * (i / 33));
            const auto found = ray(camera, x_px);
            ASSERT_TRUE(found) << camera.model << " at " << x_px.transpose();
            EXPECT_NEAR(found->norm(), 1.0, 1e-12);
            const auto back_px = project(camera, 3.0 * *found);
            ASSERT_TRUE(back_px) << camera.model << " at " << x_px.transpose();
            // Directions occur repeatedly on the left edge, top and bottom of a panorama.
            const bool twice = camera.model == 17 && (i % 33 == 0 || i / 33 == 0 || i / 33 == 24);
            EXPECT_TRUE(twice || (*back_px - x_px).norm() < 1e-6) << camera.model;
            const auto again = ray(camera, *back_px);
            ASSERT_TRUE(again) << camera.model << " at " << x_px.transpose();
            EXPECT_LT((*again - *found).norm(), 1e-9) << camera.model;
        }
    }
}

/// Model 4, as in docs.opencv.org, "Camera Calibration and 3D Reconstruction".
Vector2d opencv_pixel(const std::vector<double>& p, const Vector3d& x)
{
    const double a = x.x() / x.z();
    const double b = x.y() / x.z();
    const double r = std::hypot(a, b);
    const double radial = 1 + p[4] * std::pow(r, 2) + p[5] * std::pow(r, 4);
    const double a2 = a * radial + 2 * p[6] * a * b + p[7] * (r * r + 2 * a * a);
    const double b2 = b * radial + p[6] * (r * r + 2 * b * b) + 2 * p[7] * a * b;
    return {p[0] * a2 + p[2], p[1] * b2 + p[3]};
}

/// Model 5, as in docs.opencv.org, "Fisheye camera model".
Vector2d opencv_fisheye_pixel(const std::vector<double>& p, const Vector3d& x)
{
    const double a = x.x() / x.z();
    const double b = x.y() / x.z();
    const double r = std::hypot(a, b);
    const double theta = std::atan(r);
    double distorted = theta;
    for (int i = 1; i <= 4; ++i) {
        distorted += p[static_cast<std::size_t>(3 + i)] * std::pow(theta, 2 * i + 1);
    }
    return {p[0] * distorted / r * a + p[2], p[1] * distorted / r * b + p[3]};
}

TEST(Camera, MatchesPublishedFormulasOfOpenCv)
{
    for (int i = 0; i < 20 * 20; ++i) {
        const Vector3d x((i % 20 - 9.5) / 12, (i / 20 - 9.5) / 15, 1.2);
        const auto pixel = project(kReal[4], x);
        ASSERT_TRUE(pixel);
        EXPECT_LT((*pixel - opencv_pixel(kReal[4].params, x)).norm(), 1e-9);
        const auto fisheye_pixel = project(kReal[5], x);
        ASSERT_TRUE(fisheye_pixel);
        EXPECT_LT((*fisheye_pixel - opencv_fisheye_pixel(kReal[5].params, x)).norm(), 1e-9);
    }
}

// ---- image_shows and view_shows -----------------------------------------------------------------

Camera pinhole()
{
    return {.id = 1, .model = 1, .width_px = 200, .height_px = 100, .params = {100, 50, 100, 50}};
}

TEST(ImageShows, IncludesEdgesOfPinholeImages)
{
    // u = 100 x / z + 100, v = 50 y / z + 50.
    EXPECT_TRUE(image_shows(pinhole(), {0, 0, 1}));
    EXPECT_TRUE(image_shows(pinhole(), {1.99, -1.99, 2}));
    EXPECT_TRUE(image_shows(pinhole(), {2, -2, 2}));
    EXPECT_TRUE(image_shows(pinhole(), {-2, 2, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {2.01, 0, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {-2.01, 0, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {0, 2.01, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {0, -2.01, 2}));
    EXPECT_FALSE(image_shows(pinhole(), {0, 0, -1}));
    EXPECT_FALSE(image_shows(pinhole(), {0, 0, 0}));
}

TEST(ImageShows, UsesASingleFocalLengthForBothAxes)
{
    const Camera simple = {
        .id = 1, .model = 0, .width_px = 200, .height_px = 100, .params = {50, 100, 50}};
    EXPECT_TRUE(image_shows(simple, {1.99, 0.99, 1}));
    EXPECT_FALSE(image_shows(simple, {2.01, 0, 1}));
    EXPECT_FALSE(image_shows(simple, {0, 1.01, 1}));
}

TEST(ImageShows, AppliesDistortion)
{
    // 0.92 (1 + 0.1 * 0.92^2) = 0.998 of the half width, 0.93 (...) = 1.010.
    const Camera radial = {
        .id = 1, .model = 2, .width_px = 200, .height_px = 100, .params = {100, 100, 50, 0.1}};
    EXPECT_TRUE(image_shows(radial, {0.92, 0, 1}));
    EXPECT_FALSE(image_shows(radial, {0.93, 0, 1}));
}

TEST(ImageShows, AcceptsPointsBehindAFisheye)
{
    const Camera fisheye = {.id = 1,
                            .model = 5,
                            .width_px = 200,
                            .height_px = 200,
                            .params = {50, 50, 100, 100, 0, 0, 0, 0}};
    // The image ends at 100 px, and a radian is 50 px: 2 radians.
    EXPECT_TRUE(image_shows(fisheye, {std::sin(1.99), 0, std::cos(1.99)}));
    EXPECT_FALSE(image_shows(fisheye, {std::sin(2.01), 0, std::cos(2.01)}));
    EXPECT_TRUE(image_shows(fisheye, {0, 0, 1}));
}

TEST(ImageShows, AcceptsAllPointsInFrontOfUnknownCameras)
{
    const Camera unknown = {.id = 1, .model = -1, .width_px = 9, .height_px = 9, .params = {1, 2}};
    Camera other = unknown;
    other.model = 99;
    Camera sizeless = pinhole();
    sizeless.width_px = 0;
    Camera flat = pinhole();
    flat.height_px = 0;
    Camera incomplete = pinhole();
    incomplete.params.pop_back();
    for (const Camera& camera : {unknown, other, sizeless, flat, incomplete}) {
        EXPECT_TRUE(image_shows(camera, {1e6, 0, 1}));
        EXPECT_FALSE(image_shows(camera, {0, 0, 0}));
        EXPECT_FALSE(image_shows(camera, {0, 0, -1}));
    }
}

TEST(ViewShows, AppliesPoseOfTheView)
{
    View view;
    view.center = {10, 0, 0};
    // A quarter turn about y: the camera looks along -x.
    view.cam_from_world = Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitY());
    EXPECT_TRUE(view_shows(view, pinhole(), {0, 0, 0}));
    EXPECT_FALSE(view_shows(view, pinhole(), {20, 0, 0}));
    EXPECT_FALSE(view_shows(view, pinhole(), {10, 0, 5}));
}

} // namespace
} // namespace vcarve::camera_test
