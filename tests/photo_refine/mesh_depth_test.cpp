#include "photo_refine/mesh_depth.h"
#include "support/photographed_wall.h"
#include "support/stereo_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::mesh_depth_test {
namespace {

using Eigen::Vector3d;

/// The wall of photographed_wall.h, twice as large, at z = depth + slope x.
TriMesh wall_at(double depth, double slope)
{
    TriMesh mesh = wall_mesh(5);
    for (Vector3d& position : mesh.positions) {
        position = {2.0 * position.x(), 2.0 * position.y(), depth + slope * 2.0 * position.x()};
    }
    return mesh;
}

StereoView view_at(const Vector3d& center)
{
    return stereo_view_of(plane_along({0.0, 0.0, 1.0}, 2.0), 0, center);
}

TEST(MeshDepth, IsTheDepthAlongThePixelsRay)
{
    const TriMesh mesh = wall_at(2.0, 0.3);
    const StereoView view = view_at({0.1, -0.2, 0.0});
    const SurfaceAlong wall = plane_along({-0.3, 0.0, 1.0}, 2.0);
    const MeshDepth shown = mesh_depth(mesh, view, {});
    for (const auto& [x, y] : {std::pair{0, 0}, {80, 60}, {159, 119}, {33, 97}}) {
        const Vector3d ray =
            view.camera.ray(static_cast<float>(x), static_cast<float>(y)).cast<double>();
        EXPECT_NEAR(shown.depth[y * 160 + x], wall(view.center, ray), 1e-5) << x << ' ' << y;
    }
    EXPECT_TRUE(shown.step.empty());
}

TEST(MeshDepth, ShowsTheFirstFaceAndNothingBesideIt)
{
    TriMesh mesh = wall_at(3.0, 0.0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{-0.1, -0.1, 1.0}, {0.1, -0.1, 1.0}, {0.0, 0.2, 1.0}});
    mesh.faces.insert(mesh.faces.begin(), {first, first + 1, first + 2}); // drawn first
    mesh.positions.insert(mesh.positions.end(),
                          {{-1.0, 0.0, 0.5}, {1.0, 0.0, 0.5}, {0.0, 0.0, -1.0}});
    mesh.faces.push_back({first + 3, first + 4, first + 5}); // reaches behind the camera
    const StereoView view = view_at(Vector3d::Zero());
    const MeshDepth shown = mesh_depth(mesh, view, {});
    EXPECT_NEAR(shown.depth[60 * 160 + 80], 1.0, 1e-5);
    EXPECT_NEAR(shown.depth[60 * 160 + 10], 3.0, 1e-5);
    for (Vector3d& position : mesh.positions) {
        position.x() += 10.0;
    }
    EXPECT_TRUE(std::isinf(mesh_depth(mesh, view, {}).depth[60 * 160 + 80]));
}

TEST(MeshDepth, ChangesByTheStepDividedByTheCosine)
{
    const TriMesh mesh = wall_at(2.0, 1.0); // inclined by 45 degrees
    const std::vector<float> steps(mesh.positions.size(), 0.1F);
    const StereoView view = view_at(Vector3d::Zero());
    const MeshDepth shown = mesh_depth(mesh, view, steps);
    const Eigen::Vector3f ray = view.camera.ray(80.0F, 60.0F);
    const Eigen::Vector3f normal(std::sqrt(0.5F), 0.0F, -std::sqrt(0.5F));
    EXPECT_NEAR(shown.step[60 * 160 + 80], 0.1F / std::abs(normal.dot(ray)), 1e-5);
}

} // namespace
} // namespace vcarve::mesh_depth_test
