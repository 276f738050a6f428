#include "baselines/baseline_surface.h"
#include "io/colmap/colmap_model.h"
#include "mesh/check.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace vcarve::baseline_surface_test {
namespace {

using Eigen::Vector3d;

/// The desk of the paper, with 178 points.
Scene desk()
{
    return read_colmap_model(fixtures_folder() / "paper/desk", ModelFormat::text);
}

TriMesh alpha_shape(Scene scene, double alpha = 1.0)
{
    return baseline_surface(std::move(scene), Baseline::alpha_shape, alpha);
}

TriMesh sculpture(Scene scene)
{
    return baseline_surface(std::move(scene), Baseline::sculpture);
}

TEST(BaselineSurface, KeepsEveryFaceOfASculpture)
{
    const MeshCheck check = check_mesh(sculpture(desk()));
    // All points are on a surface of genus 0, which has 2 V - 4 faces.
    EXPECT_EQ(check.vertices, 178);
    EXPECT_EQ(check.faces, 352);
    EXPECT_TRUE(check.is_closed());
    EXPECT_EQ(check.euler_characteristic, 2);
}

TEST(BaselineSurface, KeepsEveryFaceOfAnAlphaShape)
{
    const MeshCheck check = check_mesh(alpha_shape(desk()));
    EXPECT_EQ(check.boundary_edges, 0);
    EXPECT_TRUE(check.is_closed());
    EXPECT_EQ(check.components, 1);
}

TEST(BaselineSurface, IsTheConvexHullForALargeAlpha)
{
    const TriMesh mesh = alpha_shape(desk(), 1e6);
    // No point of the mesh is in front of a face.
    for (const Face& face : mesh.faces) {
        const Vector3d& a = mesh.positions[face[0]];
        const Vector3d normal =
            (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a).normalized();
        for (const Vector3d& position : mesh.positions) {
            EXPECT_LE(normal.dot(position - a), 1e-9);
        }
    }
    EXPECT_TRUE(check_mesh(mesh).is_closed());
}

TEST(BaselineSurface, ReportsAnAlphaThatIsTooSmall)
{
    EXPECT_EQ(refusal<InputError>([] { alpha_shape(desk(), 0.001); }),
              "no cell is as small as the alpha 0.001 asks for: 1 is the smallest that keeps all "
              "points");
}

TEST(BaselineSurface, IsAWatertightManifold)
{
    for (const char* object : {"boissonnat", "cube_with_cavity", "cubicles", "desk"}) {
        const Scene scene =
            read_colmap_model(fixtures_folder() / "paper" / object, ModelFormat::text);
        for (const TriMesh& mesh : {alpha_shape(scene), sculpture(scene)}) {
            const MeshCheck check = check_mesh(mesh);
            EXPECT_TRUE(check.is_closed()) << object;
            EXPECT_TRUE(check.is_manifold()) << object;
            EXPECT_EQ(check.orientation_faults, 0) << object;
            EXPECT_EQ(check.degenerate_faces, 0) << object;
        }
    }
}

} // namespace
} // namespace vcarve::baseline_surface_test
