#include "photo_refine/refine_mesh.h"
#include "support/made_cells.h"
#include "support/photographed_wall.h"
#include "support/stereo_scene.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace vcarve::refine_mesh_test {
namespace {

using Eigen::Vector3d;
using Height = std::function<double(double x, double y)>; ///< z of a surface
using Texture = std::function<double(const Vector3d& place)>;

constexpr int kWidth = 240;
constexpr int kHeight = 180;
constexpr double kFocal = 240.0;
/// A pixel of disparity at depth 2, for rays that meet at 12 degrees.
constexpr double kPixel = 2.0 / kFocal / 0.208;

/// Photographs of a surface around z = 2 from nine viewpoints at z = 0.
class PhotographedSurface {
  public:
    explicit PhotographedSurface(const Height& height, const Texture& texture = texture_at)
    {
        scene.cameras = {{.id = 1,
                          .model = 1,
                          .width_px = kWidth,
                          .height_px = kHeight,
                          .params = {kFocal, kFocal, kWidth / 2.0, kHeight / 2.0}}};
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < 9; ++i) {
            View view;
            view.center = {0.25 * (i % 3) - 0.25, 0.25 * (i / 3) - 0.25, 0.0};
            scene.views.push_back(view);
            photos.push_back(photo_of(i, height, texture));
            all.push_back(i);
        }
        for (int i = 0; i < 40; ++i) {
            scene.positions.emplace_back(0.1 * (i % 8) - 0.35, 0.1 * (i / 8) - 0.25, 2.0);
            scene.tracks.push_back(all);
        }
    }

    /// A square from -0.6 to 0.6 on another surface, facing the cameras, refined. The column of
    /// faces right of x = 0 has a width.
    TriMesh refined(const Height& start, double middle_width = 0.6 / 7.0) const
    {
        TriMesh mesh = wall_mesh(14);
        for (Vector3d& position : mesh.positions) {
            position.head<2>() *= 0.6;
            if (position.x() > 0.01) position.x() += middle_width - 0.6 / 7.0;
            position.z() = start(position.x(), position.y());
        }
        refine_mesh(mesh, scene, photos, kWidth, {});
        return mesh;
    }

    TemporaryFolder folder;
    Scene scene;
    std::vector<CalibratedPhoto> photos;

  private:
    CalibratedPhoto photo_of(std::uint32_t i, const Height& height, const Texture& texture) const
    {
        Photograph image{kWidth, kHeight, {}};
        const Vector3d& center = scene.views[i].center;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                double gray = 0.0;
                for (const double dy : {-0.25, 0.25}) {
                    for (const double dx : {-0.25, 0.25}) {
                        const Vector3d ray((x + dx + 0.5 - kWidth / 2.0) / kFocal,
                                           (y + dy + 0.5 - kHeight / 2.0) / kFocal, 1.0);
                        gray += 0.25 * texture(first_hit(center, ray, height));
                    }
                }
                image.rgb.insert(image.rgb.end(), 3, static_cast<std::uint8_t>(gray + 0.5));
            }
        }
        CalibratedPhoto photo;
        photo.file = folder.path() / (std::to_string(i) + ".png");
        photo.size = {kWidth, kHeight};
        photo.view = i;
        photo.pose = scene.views[i];
        photo.focal_px = kFocal;
        photo.camera = scene.cameras[0];
        write_photograph(photo.file, image);
        return photo;
    }

    /// Goes along the ray in small steps until it is behind the surface.
    static Vector3d first_hit(const Vector3d& center, const Vector3d& ray, const Height& height)
    {
        double before = 1.5;
        double depth = before;
        const auto is_behind = [&](double z) {
            return z >= height(center.x() + z * ray.x(), center.y() + z * ray.y());
        };
        while (depth < 4.0 && !is_behind(depth)) {
            before = depth;
            depth += 0.01;
        }
        for (int i = 0; i < 20; ++i) {
            const double middle = 0.5 * (before + depth);
            (is_behind(middle) ? depth : before) = middle;
        }
        return center + depth * ray;
    }
};

/// The mean distance in z of the vertices between these x, away from the rim.
double mean_error(const TriMesh& mesh, const Height& height, double from = -0.45, double to = 0.45)
{
    double sum = 0.0;
    int count = 0;
    for (const Vector3d& position : mesh.positions) {
        if (position.x() < from || position.x() > to || std::abs(position.y()) > 0.35) continue;
        sum += std::abs(position.z() - height(position.x(), position.y()));
        ++count;
    }
    return sum / count;
}

double ball(double x, double y)
{
    return 3.5 - std::sqrt(std::max(0.3, 1.5 * 1.5 - x * x - y * y)); // with a floor behind it
}

double carved_ball(double x, double y)
{
    return ball(x, y) + 0.02 * std::sin(16.0 * x) * std::sin(16.0 * y);
}

TEST(RefineMesh, RecoversReliefToATenthOfAPixel)
{
    const PhotographedSurface surface(carved_ball);
    const TriMesh mesh = surface.refined(ball);
    EXPECT_GT(mesh.positions.size(), 700U) << "faces as fine as the photographs";
    EXPECT_LT(mean_error(mesh, carved_ball), 0.1 * kPixel);
    EXPECT_GT(mean_error(mesh, ball), 0.15 * kPixel) << "without relief";
}

TEST(RefineMesh, BringsBackAShiftedMesh)
{
    const PhotographedSurface surface(ball);
    for (const double pixels : {-1.0, 1.0}) {
        const TriMesh mesh =
            surface.refined([&](double x, double y) { return ball(x, y) + pixels * kPixel; });
        EXPECT_LT(mean_error(mesh, ball), 0.1 * kPixel) << pixels;
    }
}

TEST(RefineMesh, LeavesAPartWithoutTextureWhereItWas)
{
    const Height flat = [](double, double) { return 2.0; };
    const Height start = [](double, double) { return 2.0 + 0.5 * kPixel; };
    const PhotographedSurface surface(
        flat, [](const Vector3d& place) { return place.x() > 0.0 ? 128.0 : texture_at(place); });
    const TriMesh mesh = surface.refined(start);
    EXPECT_LT(mean_error(mesh, flat, -0.45, -0.1), 0.1 * kPixel);
    EXPECT_LT(mean_error(mesh, start, 0.25, 0.45), 0.05 * kPixel);
}

TEST(RefineMesh, KeepsAStepEdge)
{
    // A ramp two pixels wide between two levels.
    constexpr double kRamp = 2.0 * 2.0 / kFocal;
    const Height step = [](double x, double) {
        return 2.0 + 0.1 * std::clamp(x / kRamp, 0.0, 1.0);
    };
    const TriMesh mesh = PhotographedSurface(step).refined(step, kRamp);
    for (const Vector3d& position : mesh.positions) {
        if (std::abs(position.x()) > 0.4 || std::abs(position.y()) > 0.35) continue;
        // One pixel beside the ramp, the levels are as they were.
        if (position.x() > -2.0 / kFocal && position.x() < kRamp + 2.0 / kFocal) continue;
        EXPECT_NEAR(position.z(), step(position.x(), 0.0), 0.5 * kPixel) << position.x();
    }
}

TEST(RefineMesh, IsTheSameForAnyThreadCount)
{
    const PhotographedSurface surface(carved_ball);
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return surface.refined(ball); });
    };
    const TriMesh one = by(1);
    const TriMesh two = by(2);
    EXPECT_EQ(one.positions, two.positions);
    EXPECT_EQ(one.faces, two.faces);
}

TEST(RefineMesh, SkipsUnreadablePhotographs)
{
    const PhotographedSurface surface(carved_ball);
    surface.folder.write("4.png", "no image");
    EXPECT_LT(mean_error(surface.refined(ball), carved_ball), 0.15 * kPixel);
}

} // namespace
} // namespace vcarve::refine_mesh_test
