#include "model/camera.h"
#include "picture/shade.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>

namespace vcarve::shade_test {
namespace {

using Eigen::Array3f;
using Eigen::Vector3d;

constexpr int kWidth = 8;
constexpr int kHeight = 6;

/// An eye at the origin that looks along z. A pixel of 8 x 6 is half a unit wide at z = 4.
Eye eye_ahead()
{
    Eye eye;
    eye.camera = {
        .id = 1, .model = 0, .width_px = kWidth, .height_px = kHeight, .params = {8, 4, 3}};
    return eye;
}

/// Two faces at z = 4: one on the left shows its front, one on the upper right its back.
TriMesh front_and_back()
{
    TriMesh mesh;
    mesh.positions = {{0, -100, 4}, {-100, 0, 4}, {0, 100, 4},
                      {0, 0, 4},    {0, -100, 4}, {100, 0, 4}};
    mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    return mesh;
}

/// The brightness at a pixel of a wall perpendicular to the axis: the mean of four rays.
float light_at(int x, int y)
{
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double slope_x = (x + 0.25 + 0.5 * (i % 2) - 4.0) / 8.0;
        const double slope_y = (y + 0.25 + 0.5 * (i / 2) - 3.0) / 8.0;
        sum += 0.55 + 0.45 / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    }
    return static_cast<float>(sum / 4.0);
}

/// Expects the picture of front_and_back() with a front of this color.
void expect_front_and_back(const Looks& looks, const Array3f& color)
{
    ASSERT_EQ(looks.shaded.width_px, kWidth);
    ASSERT_EQ(looks.shaded.height_px, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            Array3f shaded = y < 3 ? kBack : kNothing;
            Array3f normal = shaded;
            if (x < 4) {
                shaded = light_at(x, y) * color;
                normal = {127.5F, 127.5F, 127.5F * 1.75F}; // towards the eye
            }
            const std::size_t pixel = static_cast<std::size_t>(y) * kWidth + x;
            // Rays are interpolated within pixels with an error of at most 0.01 px.
            EXPECT_LT((looks.shaded.pixels[pixel] - shaded).abs().maxCoeff(), 0.1F)
                << x << ", " << y;
            EXPECT_LT((looks.normals.pixels[pixel] - normal).abs().maxCoeff(), 1e-3F)
                << x << ", " << y;
        }
    }
}

/// A mesh of random faces in front of the eye, each of one color.
TriMesh strewn(int count)
{
    std::mt19937 random(7);
    const auto share = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    TriMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vector3d middle(4.0 * share(), 3.0 * share(), 3.0 + 2.0 * share());
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const Color color = {static_cast<std::uint8_t>(random() % 256), 90,
                             static_cast<std::uint8_t>(random() % 256)};
        for (int k = 0; k < 3; ++k) {
            mesh.positions.emplace_back(middle + 0.8 * Vector3d(share(), share(), share()));
            mesh.colors.push_back(color);
        }
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// The color of a ray from the origin, by brute force.
Array3f tried(const TriMesh& mesh, const Vector3d& towards)
{
    double nearest = std::numeric_limits<double>::infinity();
    Array3f color = kNothing;
    for (const Face& face : mesh.faces) {
        const Vector3d& p = mesh.positions[face[0]];
        const Vector3d u = mesh.positions[face[1]] - p;
        const Vector3d v = mesh.positions[face[2]] - p;
        Eigen::Matrix3d system;
        system << -towards, u, v;
        const Vector3d found = system.fullPivLu().solve(-p);
        const bool met = found[0] > 0.0 && found[0] < nearest && found[1] >= 0.0 &&
                         found[2] >= 0.0 && found[1] + found[2] <= 1.0;
        if (!met) continue;
        nearest = found[0];
        const double facing = -u.cross(v).normalized().dot(towards);
        const Color& own = mesh.colors[face[0]];
        color = facing > 0.0
                    ? static_cast<float>(0.55 + 0.45 * facing) * Array3f(own[0], own[1], own[2])
                    : kBack;
    }
    return color;
}

TEST(LookAt, DrawsUncoloredFrontsGrayAndBacksFlat)
{
    expect_front_and_back(look_at(front_and_back(), {}, eye_ahead(), 48), kUncolored);
}

TEST(LookAt, DrawsVertexColors)
{
    TriMesh mesh = front_and_back();
    mesh.colors.assign(mesh.positions.size(), Color{10, 200, 30});
    expect_front_and_back(look_at(mesh, {}, eye_ahead(), 48), {10.0F, 200.0F, 30.0F});
}

TEST(LookAt, InterpolatesVertexColors)
{
    TriMesh mesh;
    mesh.positions = {{-2, -50, 4}, {-2, 50, 4}, {2, 0, 4}};
    mesh.faces = {{0, 1, 2}};
    mesh.colors = {{0, 80, 0}, {0, 80, 0}, {240, 80, 0}};
    const Looks looks = look_at(mesh, {}, eye_ahead(), 48);
    // The center of a pixel in column 2 is 2.5 of 8 pixels from the left edge of the face.
    EXPECT_NEAR(looks.shaded.pixels[3 * kWidth + 2][0] / light_at(2, 3), 240.0 * 2.5 / 8.0, 0.5);
    EXPECT_NEAR(looks.shaded.pixels[3 * kWidth + 2][1] / light_at(2, 3), 80.0, 0.1);
}

TEST(LookAt, ColorsNormalsByCameraAxes)
{
    // A floor below a camera that looks along -x; world z is up.
    TriMesh mesh;
    mesh.positions = {{5, -50, -1}, {5, 50, -1}, {-90, 0, -1}};
    mesh.faces = {{0, 1, 2}};
    Eye eye = eye_ahead();
    Eigen::Matrix3d axes;
    axes << 0, 1, 0, 0, 0, -1, -1, 0, 0;
    eye.cam_from_world = Eigen::Quaterniond(axes);
    const Looks looks = look_at(mesh, {}, eye, 48);
    const Array3f upwards(127.5F, 127.5F * 1.75F, 127.5F);
    EXPECT_LT((looks.normals.pixels[5 * kWidth + 4] - upwards).abs().maxCoeff(), 1e-3F);
    EXPECT_TRUE((looks.normals.pixels[0] == kNothing).all());
}

TEST(LookAt, LooksThroughBacksOnlyToFronts)
{
    TriMesh mesh = front_and_back();
    for (const double x : {-100.0, 0.0, 100.0}) {
        mesh.positions.emplace_back(x, x == 0.0 ? -200.0 : 100.0, 2.0);
    }
    mesh.faces.push_back({6, 7, 8}); // a back side in front of all
    Eye eye = eye_ahead();
    const auto is_back = [&](int x, int y) {
        const Looks looks = look_at(mesh, {}, eye, 48);
        return (looks.shaded.pixels[static_cast<std::size_t>(y) * kWidth + x] == kBack).all();
    };
    EXPECT_TRUE(is_back(1, 1));
    eye.through_backs = true;
    EXPECT_FALSE(is_back(1, 1));
    EXPECT_TRUE(is_back(6, 1));
    EXPECT_TRUE(is_back(6, 5));
}

TEST(LookAt, MatchesBruteForceWithADistortedLens)
{
    const TriMesh mesh = strewn(150);
    Eye eye;
    eye.camera = {.id = 1,
                  .model = 4,
                  .width_px = 80,
                  .height_px = 60,
                  .params = {70, 68, 41, 29, -0.3, 0.12, 0.01, -0.005}};
    const Looks looks = look_at(mesh, {}, eye, 40.0 * 30.0);
    ASSERT_EQ(looks.shaded.pixels.size(), 1200U);
    int different = 0;
    int fronts = 0;
    for (int i = 0; i < 1200; ++i) {
        Array3f mean = Array3f::Zero();
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector2d place(2.0 * (i % 40) + 0.5 + k % 2, 2.0 * (i / 40) + 0.5 + k / 2);
            mean += tried(mesh, ray(eye.camera, place).value()) / 4;
        }
        different += (mean - looks.shaded.pixels[i]).abs().maxCoeff() > 1.0F ? 1 : 0;
        fronts += (mean - kNothing).abs().maxCoeff() > 1.0F ? 1 : 0;
    }
    EXPECT_GT(fronts, 400);
    // Interpolated rays may pass an edge on the other side.
    EXPECT_LE(different, 6);
}

TEST(LookAt, MarksPixelsWithoutADirection)
{
    Eye eye = eye_ahead();
    eye.camera.model = 2; // SIMPLE_RADIAL, not invertible in the whole image
    eye.camera.params = {2, 4, 3, -0.5};
    const Looks looks = look_at(front_and_back(), {}, eye, 48);
    EXPECT_TRUE((looks.shaded.pixels[0] == kNoRay).all());
    EXPECT_TRUE((looks.normals.pixels[0] == kNoRay).all());
    EXPECT_GT(looks.shaded.pixels[3 * kWidth + 3][0], 150.0F);
    EXPECT_FALSE((looks.shaded.pixels[3 * kWidth + 3] == kNoRay).all());
}

TEST(LookAt, IsIndependentOfThreadCountAndOffset)
{
    TriMesh mesh = strewn(30000);
    const Looks first = look_at(mesh, {}, eye_ahead(), 40000);
    for (const std::size_t threads : {1U, 2U, 3U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const Looks looks = look_at(mesh, {}, eye_ahead(), 40000);
        EXPECT_EQ(looks.shaded.pixels.size(), first.shaded.pixels.size());
        const auto same = [](const Array3f& a, const Array3f& b) { return (a == b).all(); };
        EXPECT_TRUE(std::ranges::equal(looks.shaded.pixels, first.shaded.pixels, same));
        EXPECT_TRUE(std::ranges::equal(looks.normals.pixels, first.normals.pixels, same));
    }
    mesh.offset = {1024, -2048, 512};
    Eye moved = eye_ahead();
    moved.center = mesh.offset;
    const Looks looks = look_at(mesh, {}, moved, 40000);
    const auto same = [](const Array3f& a, const Array3f& b) { return (a == b).all(); };
    EXPECT_TRUE(std::ranges::equal(looks.shaded.pixels, first.shaded.pixels, same));
}

TEST(LookAt, DrawsEmptyMeshes)
{
    const Looks looks = look_at({}, {}, eye_ahead(), 48);
    for (const Picture& picture : {looks.shaded, looks.normals}) {
        ASSERT_EQ(picture.pixels.size(), 48U);
        for (const Array3f& pixel : picture.pixels) {
            EXPECT_TRUE((pixel == kNothing).all());
        }
    }
}

TEST(LookAt, DrawsTexturesUnlit)
{
    const TriMesh mesh = front_and_back();
    Texture texture;
    texture.pages = {Photograph{2, 1, {10, 20, 30, 110, 120, 130}}};
    texture.page_of_face = {0, 0};
    texture.places.resize(2);
    texture.places[0].fill({0.5F, 0.5F}); // between both texels
    const Looks looks = look_at(mesh, texture, eye_ahead(), 48);
    EXPECT_TRUE(looks.shaded.pixels[0].isApprox(Array3f(60, 70, 80))) << looks.shaded.pixels[0];
    texture.places[0].fill({0.0F, 0.0F});
    EXPECT_TRUE(
        look_at(mesh, texture, eye_ahead(), 48).shaded.pixels[0].isApprox(Array3f(10, 20, 30)));
}

} // namespace
} // namespace vcarve::shade_test
