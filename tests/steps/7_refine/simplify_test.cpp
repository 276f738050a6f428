#include "mesh/check.h"
#include "steps/7_refine/refine.h"
#include "support/blocked_rays.h"
#include "support/half_edges.h"
#include "support/measured_scenes.h"
#include "support/scenes.h"
#include "vcarve/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vcarve::simplify_test {
namespace {

using Eigen::Vector3d;
using testing::blocked_rays;
using testing::empty_scene;
using testing::flat_grid;
using testing::half_edges;
using testing::margins_in;

TriMesh simplified(const TriMesh& mesh, const RayGuard& guard, const SimplifyOptions& options)
{
    HalfEdgeMesh surface = half_edges(mesh);
    const SimplifyCounts counts = simplify_surface(surface, guard, options);
    TriMesh simple = tri_mesh(surface);
    EXPECT_EQ(counts.faces_before, static_cast<std::int64_t>(mesh.faces.size()));
    EXPECT_EQ(counts.faces, static_cast<std::int64_t>(simple.faces.size()));
    return simple;
}

RayGuard unguarded()
{
    return {empty_scene(), half_edges({})};
}

std::size_t face_count(const TriMesh& mesh)
{
    return mesh.faces.size();
}

TEST(SimplifySurface, KeepsTheShapeOfAFlatSquare)
{
    const RayGuard guard = unguarded();
    const TriMesh simple = simplified(flat_grid(11), guard, {.faces = 20});
    EXPECT_LE(face_count(simple), 20U);
    EXPECT_GE(face_count(simple), 19U);
    const MeshCheck check = check_mesh(simple);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_NEAR(check.area, 1.0, 1e-12);
    for (const Vector3d& corner : {Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}) {
        EXPECT_EQ(std::ranges::count(simple.positions, corner), 1);
    }
}

/// 4 sqrt(3) area over the sum of the squared edges: 1 for an equilateral triangle.
double roundness(const TriMesh& mesh, const Face& face)
{
    const Vector3d ab = mesh.positions[face[1]] - mesh.positions[face[0]];
    const Vector3d ac = mesh.positions[face[2]] - mesh.positions[face[0]];
    const double sum_sq = ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm();
    return 2.0 * std::sqrt(3.0) * ab.cross(ac).norm() / sum_sq;
}

TEST(SimplifySurface, MakesNoSlivers)
{
    // All collapses in the plane have the same cost, so only the rule prevents slivers.
    const RayGuard guard = unguarded();
    for (const int faces : {800, 400, 200, 100}) {
        const TriMesh simple = simplified(flat_grid(25), guard, {.faces = faces});
        EXPECT_LE(face_count(simple), static_cast<std::size_t>(faces));
        for (const Face& face : simple.faces) {
            EXPECT_GE(roundness(simple, face), 0.1);
        }
    }
}

TEST(SimplifySurface, MakesNoFolds)
{
    // Random heights, at which collapses could fold faces over. All faces must face up.
    TriMesh mesh = flat_grid(41);
    std::mt19937 random(3);
    for (Vector3d& position : mesh.positions) {
        const bool is_inner =
            (position.head<2>().array() * (1.0 - position.head<2>().array()) > 1e-9).all();
        if (is_inner) position.z() = 0.02 * static_cast<double>(random()) / 4294967296.0;
    }
    const RayGuard guard = unguarded();
    // Few enough vertices are merged that no face turns twice.
    const TriMesh simple = simplified(mesh, guard, {.faces = 2600});
    for (const Face& face : simple.faces) {
        const Vector3d ab = simple.positions[face[1]] - simple.positions[face[0]];
        const Vector3d ac = simple.positions[face[2]] - simple.positions[face[0]];
        ASSERT_GT(ab.cross(ac).z(), -1e-12);
    }
}

TEST(SimplifySurface, KeepsAMeshWithFewEnoughFaces)
{
    const RayGuard guard = unguarded();
    const TriMesh mesh = testing::cube();
    EXPECT_EQ(simplified(mesh, guard, {.faces = 12}).faces, mesh.faces);
}

TEST(SimplifySurface, StopsBeforeASolidVanishes)
{
    const RayGuard guard = unguarded();
    const TriMesh two =
        testing::together(testing::torus(12), testing::moved(testing::cube(), {9, 0, 0}));
    const MeshCheck check = check_mesh(simplified(two, guard, {.faces = 1}));
    EXPECT_TRUE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.components, 2);
    EXPECT_EQ(check.euler_characteristic, 2);
    EXPECT_LT(check.faces, 100);
}

TEST(SimplifySurface, KeepsAFlatTetrahedron)
{
    // Its apex could move to a corner without turning a face or making a sliver, but the surface
    // would no longer be closed.
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 0.02}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const RayGuard guard = unguarded();
    const TriMesh simple = simplified(mesh, guard, {.faces = 1});
    EXPECT_EQ(simple.faces, mesh.faces);
    EXPECT_TRUE(check_mesh(simple).is_closed());
}

/// A corrugated sheet, and points just above its vertices. Their whole rays count, so no face may
/// fill a trough.
struct Sheet {
    TriMesh mesh = flat_grid(25);
    Scene scene;
};

Sheet corrugated_sheet()
{
    Sheet sheet;
    std::vector<MadePoint> points;
    for (Vector3d& position : sheet.mesh.positions) {
        position.z() = 0.1 * std::cos(25.0 * position.x());
        points.push_back({position + Vector3d(0, 0, 0.005), {0, 1, 2}});
    }
    sheet.mesh.points.assign(sheet.mesh.points.size(), kNoPoint);
    sheet.scene = make_scene({{0.5, 0.5, 5}, {-2, 0.5, 5}, {3, 0.5, 5}}, points);
    return sheet;
}

TEST(SimplifySurface, BlocksNoFreeRay)
{
    const auto sheet = corrugated_sheet();
    const TriMesh& mesh = sheet.mesh;
    const Scene& scene = sheet.scene;
    const std::vector<double> margins = margins_in(mesh, scene);
    const auto blocked_before = blocked_rays(scene, mesh, margins);
    const auto newly_blocked = [&](const RayGuard& guard) {
        const TriMesh simple = simplified(mesh, guard, {.faces = 30});
        auto blocked = blocked_rays(scene, simple, margins);
        for (const auto& ray : blocked_before) {
            blocked.erase(ray);
        }
        return blocked.size();
    };
    EXPECT_GT(newly_blocked(unguarded()), 0U);
    EXPECT_EQ(newly_blocked(RayGuard(scene, half_edges(mesh))), 0U);
}

/// The result of simplifying the mesh of a scene to a quarter.
struct Simplified {
    Reconstruction before;
    TriMesh after;
    std::size_t newly_blocked = 0;
};

Simplified quarter(bool closed)
{
    Log silent;
    Options options;
    options.surface.closed = closed;
    options.denoise.denoise = 0.0; // vertices stay at their points
    Simplified result{reconstruct(bumpy_sphere(500, 4), options, silent), {}};
    const auto& scene = result.before.scene;
    const auto& mesh = result.before.mesh;
    const RayGuard guard(scene, half_edges(mesh));
    result.after = simplified(mesh, guard, {.faces = static_cast<int>(face_count(mesh) / 4)});
    const std::vector<double> margins = margins_in(mesh, scene);
    const auto blocked_before = blocked_rays(scene, mesh, margins);
    for (const auto& ray : blocked_rays(scene, result.after, margins)) {
        result.newly_blocked += blocked_before.contains(ray) ? 0 : 1;
    }
    return result;
}

TEST(SimplifySurface, BlocksNoRayOfAWholeScene)
{
    const Simplified simplified = quarter(false);
    EXPECT_EQ(simplified.newly_blocked, 0U);
    EXPECT_LT(face_count(simplified.after), 0.6 * face_count(simplified.before.mesh));
}

TEST(SimplifySurface, KeepsAClosedManifoldClosed)
{
    const Simplified simplified = quarter(true);
    const MeshCheck check = check_mesh(simplified.after);
    EXPECT_TRUE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.unreferenced_vertices, 0);
    EXPECT_EQ(check.euler_characteristic, check_mesh(simplified.before.mesh).euler_characteristic);
}

TEST(SimplifySurface, KeepsPositionColorAndPointOfRemainingVertices)
{
    const Simplified simplified = quarter(false);
    const auto& scene = simplified.before.scene;
    const TriMesh& mesh = simplified.after;
    ASSERT_EQ(mesh.points.size(), mesh.positions.size());
    ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.points[v] == kNoPoint) continue;
        EXPECT_EQ(mesh.positions[v], scene.positions[mesh.points[v]]);
        EXPECT_EQ(mesh.colors[v], scene.colors[mesh.points[v]]);
    }
}

TEST(SimplifySurface, ScalesWithTheSurface)
{
    const TriMesh mesh = corrugated_sheet().mesh;
    TriMesh large = mesh;
    for (Vector3d& position : large.positions) {
        position *= 1024.0;
    }
    const RayGuard guard = unguarded();
    EXPECT_EQ(simplified(large, guard, {.faces = 200}).faces,
              simplified(mesh, guard, {.faces = 200}).faces);
}

} // namespace
} // namespace vcarve::simplify_test
