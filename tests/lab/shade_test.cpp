#include "lab/box_ahead.h"
#include "render/shade.h"
#include "render/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace vcarve::render {

namespace {

bool is_on_box(int x, int y)
{
    return x >= 2 && x < 6 && y >= 1 && y < 5;
}

/// How bright a wall square to the view's axis is, lit from the camera: the mean of a pixel's nine
/// samples.
double light_at(int x, int y)
{
    double sum = 0.0;
    for (int k = 0; k < 9; ++k) {
        const double slope_x = (x + (k % 3 + 0.5) / 3.0 - 4.0) / 8.0;
        const double slope_y = (y + (k / 3 + 0.5) / 3.0 - 3.0) / 8.0;
        sum += 0.35 + 0.65 / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    }
    return sum / 9.0;
}

void expect_box_of(const Picture& picture, const Eigen::Array3f& color)
{
    ASSERT_EQ(picture.pixels.size(), 48U);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 8; ++x) {
            const Eigen::Array3f expected =
                is_on_box(x, y) ? (static_cast<float>(light_at(x, y)) * color).eval()
                                : Eigen::Array3f::Constant(255.0F);
            const Eigen::Array3f& pixel = picture.pixels[y * 8 + x];
            EXPECT_LT((pixel - expected).abs().maxCoeff(), 1e-3F) << "pixel " << x << ", " << y;
        }
    }
}

} // namespace

TEST(Shade, LightsAPlainBoxFromTheCamera)
{
    expect_box_of(shade(box_ahead(), view_ahead(), {}), {200.0F, 200.0F, 205.0F});
}

TEST(Shade, ShowsBacksInMagenta)
{
    TriMesh mesh = box_ahead();
    for (Face& face : mesh.faces) {
        std::swap(face[1], face[2]);
    }
    mesh.colors.assign(mesh.positions.size(), Color{10, 200, 30});
    expect_box_of(shade(mesh, view_ahead(), {}), {255.0F, 0.0F, 255.0F});
}

TEST(Shade, TakesTheColorsOfTheMeshUnlessPlainOnesAreAskedFor)
{
    TriMesh mesh = box_ahead();
    mesh.colors.assign(mesh.positions.size(), Color{10, 200, 30});
    expect_box_of(shade(mesh, view_ahead(), {}), {10.0F, 200.0F, 30.0F});
    expect_box_of(shade(mesh, view_ahead(), {.use_colors = false}), {200.0F, 200.0F, 205.0F});
}

TEST(Shade, DrawsAnEdgeWhereTheSampleToTheRightOrBelowShowsAnotherFace)
{
    const Picture picture = shade(box_ahead(), view_ahead(), {.draw_edges = true});
    const auto pixel = [&](int x, int y) { return picture.pixels[y * 8 + x]; };
    // Left of the box there is nothing, and nothing has no edges.
    EXPECT_TRUE(((pixel(1, 2) - 255.0F).abs() < 1e-3F).all()) << pixel(1, 2).transpose();
    // Of the box's last column, the third of the samples at its border, lit by 0.35 + 0.65 / 1.02
    // and more.
    EXPECT_NEAR(pixel(5, 2)[0], (6.0 * 0.98 * 200.0 + 3.0 * 30.0) / 9.0, 2.0);
    // Amid a face there are none.
    const auto inside = static_cast<float>(200.0 * light_at(4, 1));
    EXPECT_NEAR(pixel(4, 1)[0], inside, 1e-3F);
}

TEST(Shade, LooksAtTheMiddleOfTheMeshFromFarEnoughToHoldItAll)
{
    const TriMesh mesh = box_ahead();
    const Pinhole view = view_of_whole(mesh, {{-1.0, -2.0, 1.5}, {0.0, 0.0, 1.0}}, 80);
    EXPECT_EQ(view.width_px, 80);
    EXPECT_EQ(view.height_px, 60);
    const Eigen::Vector3d middle = view.cam_from_world * (Eigen::Vector3d(0, 0, 5) - view.center);
    EXPECT_NEAR(middle.x(), 0.0, 1e-12);
    EXPECT_NEAR(middle.y(), 0.0, 1e-12);
    for (const Eigen::Vector3d& corner : mesh.positions) {
        const Eigen::Vector3d in_camera = view.cam_from_world * (corner - view.center);
        ASSERT_GT(in_camera.z(), 0.0);
        const Eigen::Vector2d pixel =
            view.principal_px + view.focal_px.cwiseProduct(in_camera.head<2>() / in_camera.z());
        EXPECT_TRUE((pixel.array() > 0.0).all() && pixel.x() < 80.0 && pixel.y() < 60.0);
    }
}

} // namespace vcarve::render
