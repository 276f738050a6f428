#include "model/camera.h"
#include "picture/eye.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace vcarve::eye_test {
namespace {

using Eigen::Vector3d;

View view_of(std::uint32_t id, const Vector3d& center)
{
    View view;
    view.id = id;
    view.name = std::string(1, static_cast<char>('a' + id)) + ".jpg";
    view.center = center;
    return view;
}

/// Three views side by side, which look along z at four points at z = 10; -y is up. Views 0 and 2
/// see three points, view 1 sees one.
Scene scene_ahead()
{
    Scene scene;
    scene.cameras = {
        {.id = 4, .model = 0, .width_px = 40, .height_px = 30, .params = {40, 20, 15}}};
    scene.views = {view_of(0, {-1, 0, 0}), view_of(1, {0, 0, 0}), view_of(2, {1, 0, 0})};
    scene.positions = {{-1, -1, 10}, {1, -1, 10}, {-1, 1, 10}, {1, 1, 10}};
    const std::array<std::vector<std::uint32_t>, 4> tracks = {{{0, 2}, {0, 2}, {0}, {1, 2}}};
    for (const auto& track : tracks) {
        scene.tracks.push_back(track);
    }
    scene.offset = {100, 200, 300};
    return scene;
}

/// Projects a point of the model's frame to a pixel.
Eigen::Vector2d pixel_of(const Eye& eye, const Vector3d& place)
{
    return project(eye.camera, eye.cam_from_world * (place - eye.center)).value();
}

TEST(ChooseEye, SelectsTheFirstViewThatSeesMost)
{
    const Eye eye = choose_eye(scene_ahead(), "auto");
    EXPECT_EQ(eye.name, "a.jpg");
    EXPECT_EQ(eye.center, Vector3d(99, 200, 300));
    EXPECT_FALSE(eye.through_backs);
    Scene scene = scene_ahead();
    scene.positions.emplace_back(0, 0, 10);
    scene.tracks.push_back(std::vector<std::uint32_t>{2});
    EXPECT_EQ(choose_eye(scene, "auto").name, "c.jpg");
}

TEST(ChooseEye, SkipsViewsWithUnknownLenses)
{
    Scene scene = scene_ahead();
    scene.cameras.push_back({.id = 5, .model = -1, .width_px = 40, .height_px = 30, .params = {}});
    scene.views[0].camera = 1;
    scene.views[2].camera = 1;
    EXPECT_EQ(choose_eye(scene, "auto").name, "b.jpg");
    scene.views[1].camera = 1;
    EXPECT_EQ(choose_eye(scene, "auto").name, "orbit");
    EXPECT_EQ(refusal<UsageError>([&] { choose_eye(scene, "b.jpg"); }),
              "--view b.jpg: the view through camera 5 cannot be drawn, because its lens model is "
              "unknown");
}

TEST(ChooseEye, SelectsAViewByName)
{
    EXPECT_EQ(choose_eye(scene_ahead(), "b.jpg").center, Vector3d(100, 200, 300));
}

TEST(ChooseEye, RefusesUnknownNames)
{
    Scene scene = scene_ahead();
    EXPECT_EQ(
        refusal<UsageError>([&] { choose_eye(scene, "x.jpg"); }),
        "--view must be auto, top, orbit or the name of an image, but \"x.jpg\" is none of the 3 "
        "images (a.jpg, b.jpg, c.jpg)");
    scene.views.push_back(view_of(3, {0, 0, 0}));
    EXPECT_EQ(refusal<UsageError>([&] { choose_eye(scene, ""); }),
              "--view must be auto, top, orbit or the name of an image, but \"\" is none of the 4 "
              "images (a.jpg, b.jpg, c.jpg, ...)");
    scene.views[0].name = "a\x1b[2J";
    EXPECT_THAT(
        refusal<UsageError>([&] { choose_eye(scene, "x"); }),
        ::testing::HasSubstr("but \"x\" is none of the 4 images (a?[2J, b.jpg, c.jpg, ...)"));
}

TEST(ChooseEye, LooksDownFromTopWithCamerasAtTheBottom)
{
    const Eye eye = choose_eye(scene_ahead(), "top");
    EXPECT_TRUE(eye.through_backs);
    EXPECT_EQ(picture_size(eye.camera, 1280.0 * 960.0).x(), 1280);
    // Straight above the center of the ball; up is -y.
    const Vector3d down = eye.cam_from_world.conjugate() * Vector3d::UnitZ();
    EXPECT_TRUE(down.isApprox(Vector3d::UnitY(), 1e-12)) << down.transpose();
    const Vector3d middle = eye.center + down * 5.0;
    EXPECT_TRUE(pixel_of(eye, middle).isApprox(Eigen::Vector2d(640, 480), 1e-9));
    // Points nearer to the cameras are lower in the picture.
    EXPECT_GT(pixel_of(eye, middle - Vector3d::UnitZ()).y(), 480.0);
    EXPECT_GT(pixel_of(eye, middle + Vector3d::UnitX()).x(), 640.0);
}

TEST(ChooseEye, LooksFromTheSideOfTheCamerasFromOrbit)
{
    const Eye eye = choose_eye(scene_ahead(), "orbit");
    EXPECT_EQ(eye.name, "orbit");
    const Vector3d ahead = eye.cam_from_world.conjugate() * Vector3d::UnitZ();
    EXPECT_NEAR(ahead.y(), std::sin(35.0 * EIGEN_PI / 180.0), 1e-12);
    EXPECT_GT(ahead.z(), 0.8);
    // Up is up in the picture, and all points are in it.
    const Vector3d middle(100, 200, 310);
    EXPECT_LT(pixel_of(eye, middle - 0.1 * Vector3d::UnitY()).y(), pixel_of(eye, middle).y());
    for (const Vector3d& position : scene_ahead().positions) {
        const Eigen::Vector2d pixel = pixel_of(eye, position + Vector3d(100, 200, 300));
        EXPECT_TRUE((pixel.array() > 0.0).all() && pixel.x() < 1280.0 && pixel.y() < 960.0);
    }
}

TEST(ChooseEye, UsesBackwardAsUpIfUpDirectionsCancelOut)
{
    // A drone looks straight down on its way out and on its way back.
    Scene scene = scene_ahead();
    scene.views.resize(2);
    scene.tracks = {};
    for (int i = 0; i < 4; ++i) {
        scene.tracks.push_back(std::vector<std::uint32_t>{0, 1});
    }
    scene.views[1].cam_from_world = Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitZ());
    const Eye eye = choose_eye(scene, "top");
    const Vector3d ahead = eye.cam_from_world.conjugate() * Vector3d::UnitZ();
    EXPECT_TRUE(ahead.isApprox(Vector3d::UnitZ(), 1e-9)) << ahead.transpose();
}

TEST(ChooseEye, UsesZAsUpForLaserScans)
{
    Scene scene = scene_ahead();
    scene.cameras[0] = {.id = 4, .model = -1, .params = {}, .measures_range = true};
    const Eye eye = choose_eye(scene, "top");
    const Vector3d ahead = eye.cam_from_world.conjugate() * Vector3d::UnitZ();
    EXPECT_TRUE(ahead.isApprox(-Vector3d::UnitZ(), 1e-9)) << ahead.transpose();
}

TEST(ChooseEye, ReturnsFiniteValuesWithoutRaysOrViews)
{
    Scene scene = scene_ahead();
    scene.views.clear();
    scene.tracks = {};
    scene.positions.clear();
    for (const char* word : {"auto", "top", "orbit"}) {
        const Eye eye = choose_eye(scene, word);
        EXPECT_TRUE(eye.center.allFinite()) << word;
        EXPECT_TRUE(eye.cam_from_world.coeffs().allFinite()) << word;
    }
}

TEST(PictureSize, KeepsTheAspectRatioWithinThePixelLimit)
{
    const auto size = [](std::uint64_t width_px, std::uint64_t height_px) -> Eigen::Array2i {
        return picture_size({.width_px = width_px, .height_px = height_px, .params = {}},
                            1280.0 * 960.0);
    };
    EXPECT_TRUE((size(4000, 3000) == Eigen::Array2i(1280, 960)).all());
    EXPECT_TRUE((size(16, 12) == Eigen::Array2i(1280, 960)).all());
    EXPECT_TRUE((size(1000, 1000) == Eigen::Array2i(1108, 1108)).all());
    EXPECT_TRUE((size(1, 100) == Eigen::Array2i(40, 4096)).all());
    EXPECT_TRUE((size(1, ~std::uint64_t{0}) == Eigen::Array2i(1, 4096)).all());
}

Camera camera_of(int model, std::vector<double> params)
{
    return {
        .id = 1, .model = model, .width_px = 1000, .height_px = 750, .params = std::move(params)};
}

TEST(LensRays, AreExactToAHundredthOfAPixel)
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

TEST(LensRays, AreEmptyWhereTheLensHasNoDirection)
{
    // This distortion is not invertible beyond a radius of 1 / sqrt(3 * 0.5) focal lengths. It maps
    // this radius to 2 / 3 of it, which is 0.544 focal lengths or 436 px.
    const Camera camera = camera_of(2, {800, 500, 375, -0.5});
    const LensRays rays(camera, {200, 150});
    const Eigen::Array2d middle(0.5, 0.5);
    EXPECT_FALSE(rays.at(12, 75, middle));
    EXPECT_TRUE(rays.at(13, 75, middle));
    EXPECT_FALSE(rays.at(0, 0, middle));
}

} // namespace
} // namespace vcarve::eye_test
