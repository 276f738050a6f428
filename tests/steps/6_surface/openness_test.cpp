#include "geometry/predicates.h"
#include "model/camera.h"
#include "model/views.h"
#include "steps/6_surface/openness.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace vcarve::openness_test {
namespace {

using Eigen::Vector3d;
using testing::aim;
using testing::LabeledScene;
using testing::solid;

/// Whether a ray meets one of the kept faces, or of all faces.
bool meets(const LabeledScene& made, const FaceFlags& keep, bool only_kept, const Vector3d& eye,
           const Vector3d& target)
{
    for (std::size_t i = 0; i < made.corners.size(); ++i) {
        if (only_kept && keep[i] == 0) continue;
        std::array<Vector3d, 3> triangle;
        for (int k = 0; k < 3; ++k) {
            triangle[k] = made.mesh.positions[made.corners[i][k]];
        }
        if (meets_triangle(eye, target, triangle)) return true;
    }
    return false;
}

struct Count {
    std::int64_t rays = 0;
    std::int64_t past = 0;
    std::int64_t open = 0;
};

/// Equals measure_openness(), but tests every face.
Count tried(const LabeledScene& made, const FaceFlags& keep, std::size_t rays_a_view)
{
    Count openness;
    for (const View& view : made.scene.views) {
        const Camera& camera = made.scene.cameras[view.camera];
        for (const Eigen::Vector2d& pixel : pixel_grid(camera, rays_a_view)) {
            const Vector3d line = view.cam_from_world.conjugate() * *ray(camera, pixel);
            const Vector3d target = view.center + 100.0 * line;
            ++openness.rays;
            if (!meets(made, keep, false, view.center, target)) {
                ++openness.past;
            } else if (!meets(made, keep, true, view.center, target)) {
                ++openness.open;
            }
        }
    }
    return openness;
}

Count measured(const LabeledScene& made, const FaceFlags& keep)
{
    const Openness openness =
        measure_openness(made.mesh, made.labels, made.facets, keep, made.scene);
    return {openness.rays, openness.past, static_cast<std::int64_t>(openness.open.size())};
}

LabeledScene solid_ball()
{
    Scene scene = bumpy_sphere(150, 3);
    for (View& view : scene.views) {
        aim(view, Vector3d::Zero());
    }
    return {scene, [](const TetMesh& mesh) { return solid(mesh); }};
}

TEST(Openness, IsZeroIfAllFacesAreKept)
{
    const LabeledScene made = solid_ball();
    const Count openness = measured(made, FaceFlags(made.facets.size(), 1));
    EXPECT_GT(openness.rays, 3000);
    EXPECT_EQ(openness.open, 0);
}

TEST(Openness, MatchesTestingEveryFace)
{
    const LabeledScene made = solid_ball();
    // Two of three faces are missing, so views see the backs of others through some gaps.
    FaceFlags keep(made.facets.size(), 0);
    for (std::size_t i = 0; i < keep.size(); i += 3) {
        keep[i] = 1;
    }
    const Count expected = tried(made, keep, 4096 / made.scene.views.size());
    const Count openness = measured(made, keep);
    EXPECT_EQ(openness.rays, expected.rays);
    EXPECT_EQ(openness.past, expected.past);
    EXPECT_EQ(openness.open, expected.open);
    EXPECT_GT(openness.open, 100);
}

TEST(Openness, CountsRaysFromInside)
{
    // Only the cells at the hull are inside, so views at the center look at them from behind.
    Scene scene = bumpy_sphere(400, 3);
    for (View& view : scene.views) {
        view.center *= 0.01;
    }
    const LabeledScene made(scene, [](const TetMesh& mesh) {
        return testing::labels_where(mesh, [&](Index cell) {
            return std::ranges::any_of(mesh.cells[cell].neighbors, [&](Index neighbor) {
                return mesh.cells[neighbor].is_infinite();
            });
        });
    });
    FaceFlags keep(made.facets.size(), 1);
    for (std::size_t i = 0; i < keep.size(); i += 2) {
        keep[i] = 0;
    }
    const Count expected = tried(made, keep, 4096 / made.scene.views.size());
    const Count openness = measured(made, keep);
    EXPECT_EQ(openness.rays, expected.rays);
    EXPECT_EQ(openness.past, expected.past);
    EXPECT_EQ(openness.open, expected.open);
    EXPECT_GT(openness.open, 100);
}

TEST(Openness, IgnoresViewsWithoutPoints)
{
    LabeledScene made = solid_ball();
    std::vector<std::uint32_t> track;
    made.scene.tracks = {};
    for (std::size_t i = 0; i < made.scene.num_points(); ++i) {
        made.scene.tracks.push_back(track);
    }
    EXPECT_EQ(measured(made, FaceFlags(made.facets.size(), 1)).rays, 0);
}

TEST(Openness, IsTheSameForAnyThreadCount)
{
    const LabeledScene made = solid_ball();
    const FaceFlags keep(made.facets.size(), 0);
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return measured(made, keep); });
    };
    EXPECT_GT(by(1).open, 100);
    EXPECT_EQ(by(1).open, by(4).open);
    EXPECT_EQ(by(1).rays, by(4).rays);
}

TEST(Openness, EndsAtFilledHoles)
{
    const std::vector<ViewLine> lines = {{{0.2, 0.2, 2}, {0.2, 0.2, -2}},
                                         {{0.2, 0.2, -2}, {0.2, 0.2, 2}},
                                         {{0.9, 0.9, 2}, {0.9, 0.9, -2}},
                                         {{0.2, 0.2, 2}, {0.2, 0.2, 1}}};
    EXPECT_EQ(count_free(lines, {}), 4);
    EXPECT_EQ(count_free(lines, {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}}), 2);
    EXPECT_EQ(count_free(lines, {{Vector3d(0, 0, 0), Vector3d(1, 1, 0), Vector3d(0.2, 0.2, 0)}}), 4)
        << "a triangle without area";
}

} // namespace
} // namespace vcarve::openness_test
