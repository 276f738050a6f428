#include "steps/7_refine/refine.h"
#include "support/blocked_rays.h"
#include "support/half_edges.h"
#include "support/measured_scenes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace vcarve::smooth_test {
namespace {

using Eigen::Vector3d;
using testing::blocked_rays;
using testing::empty_scene;
using testing::flat_grid;
using testing::half_edges;
using testing::margins_in;

constexpr std::uint32_t kSide = 21;

struct SmoothedSurface {
    TriMesh mesh;
    SmoothCounts counts;
};

SmoothedSurface smoothed(const TriMesh& mesh, const RayGuard& guard, const SmoothOptions& options)
{
    HalfEdgeMesh surface = half_edges(mesh);
    const SmoothCounts counts = smooth_surface(surface, guard, options);
    return {tri_mesh(surface), counts};
}

RayGuard unguarded()
{
    return {empty_scene(), half_edges({})};
}

TriMesh noisy_grid()
{
    std::mt19937 random(1);
    TriMesh mesh = flat_grid(kSide);
    for (Vector3d& position : mesh.positions) {
        position.z() = 0.005 * (random() / 2147483648.0 - 1.0);
    }
    return mesh;
}

bool is_on_rim(std::uint32_t vertex)
{
    const std::uint32_t x = vertex % kSide;
    const std::uint32_t y = vertex / kSide;
    return x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1;
}

double mean_square_height(const TriMesh& mesh)
{
    double sum = 0.0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (!is_on_rim(v)) sum += mesh.positions[v].z() * mesh.positions[v].z();
    }
    return sum;
}

TEST(SmoothSurface, FlattensNoiseAndKeepsFacesAndBoundary)
{
    const TriMesh mesh = noisy_grid();
    const RayGuard guard = unguarded();
    const SmoothedSurface smooth = smoothed(mesh, guard, {.iterations = 5});
    EXPECT_LT(mean_square_height(smooth.mesh), 0.3 * mean_square_height(mesh));
    EXPECT_EQ(smooth.mesh.faces, mesh.faces);
    EXPECT_EQ(smooth.mesh.points, mesh.points);
    EXPECT_EQ(smooth.counts.moved, 19 * 19);
    EXPECT_EQ(smooth.counts.held, 0);
    ASSERT_EQ(smooth.mesh.normals.size(), mesh.positions.size());
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (is_on_rim(v)) {
            EXPECT_EQ(smooth.mesh.positions[v], mesh.positions[v]);
        }
        EXPECT_GT(smooth.mesh.normals[v].z(), 0.9F);
    }
}

TEST(SmoothSurface, KeepsVerticesWithinHalfTheirSpacing)
{
    // Hills almost as high as the edge length, which unlimited smoothing would flatten.
    TriMesh mesh = flat_grid(kSide);
    for (Vector3d& position : mesh.positions) {
        constexpr double kWave = 4.0 * std::numbers::pi;
        position.z() = 0.04 * std::sin(kWave * position.x()) * std::sin(kWave * position.y());
    }
    const RayGuard guard = unguarded();
    const TriMesh smooth = smoothed(mesh, guard, {.iterations = 30}).mesh;
    const std::vector<double> spacings = testing::spacings_of(mesh);
    int at_the_end_of_their_reach = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const double share = (smooth.positions[v] - mesh.positions[v]).norm() / spacings[v];
        EXPECT_LE(share, 0.5 + 1e-9);
        at_the_end_of_their_reach += share > 0.499 ? 1 : 0;
    }
    EXPECT_EQ(at_the_end_of_their_reach, 64);
}

TEST(SmoothSurface, KeepsSharpEdges)
{
    const TriMesh mesh = testing::cube();
    const RayGuard guard = unguarded();
    const TriMesh smooth = smoothed(mesh, guard, {.iterations = 10}).mesh;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_LT((smooth.positions[v] - mesh.positions[v]).norm(), 1e-6);
    }
}

TEST(SmoothSurface, KeepsASpikeWithinHalfItsSpacing)
{
    TriMesh mesh = flat_grid(kSide);
    mesh.positions[kSide * 10 + 10].z() = 0.02; // the edge length is 0.05
    const RayGuard guard = unguarded();
    const TriMesh smooth = smoothed(mesh, guard, {.iterations = 50}).mesh;
    const std::vector<double> spacings = testing::spacings_of(mesh);
    double farthest = 0.0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const double way = (smooth.positions[v] - mesh.positions[v]).norm();
        EXPECT_LE(way, 0.5 * spacings[v] * (1 + 1e-12));
        farthest = std::max(farthest, way);
    }
    EXPECT_GT(farthest, 0.01);
}

TEST(SmoothSurface, BlocksNoRayInAPit)
{
    // A point is just above the bottom of a pit, and its ray goes up. A raised bottom would block
    // the ray.
    TriMesh mesh = flat_grid(kSide);
    const std::uint32_t middle = kSide * 10 + 10;
    mesh.positions[middle].z() = -0.02;
    const Vector3d above = mesh.positions[middle] + Vector3d(0, 0, 0.001);
    const Scene scene = make_scene({above + Vector3d(0, 0, 9)}, {{above, {0}}});
    mesh.points.assign(mesh.points.size(), kNoPoint);
    const SmoothOptions options{.iterations = 20};
    const SmoothedSurface held = smoothed(mesh, RayGuard(scene, half_edges(mesh)), options);
    const SmoothedSurface loose = smoothed(mesh, unguarded(), options);
    EXPECT_GT(loose.mesh.positions[middle].z(), above.z());
    EXPECT_LT(held.mesh.positions[middle].z(), above.z());
    EXPECT_GT(held.counts.held, 0);
}

TEST(SmoothSurface, BlocksNoFreeRay)
{
    // The points are just above the vertices, so their whole rays count.
    TriMesh mesh = noisy_grid();
    mesh.points.assign(mesh.points.size(), kNoPoint);
    std::vector<MadePoint> points;
    for (const Vector3d& position : mesh.positions) {
        points.push_back({position + Vector3d(0, 0, 0.001), {0, 1, 2}});
    }
    const Scene scene = make_scene({{0.5, 0.5, 3}, {-1, 0.5, 2}, {0.5, 4, 2}}, points);
    const std::vector<double> margins = margins_in(mesh, scene);
    const auto blocked_before = blocked_rays(scene, mesh, margins);
    const auto newly_blocked = [&](const RayGuard& guard) {
        const TriMesh smooth = smoothed(mesh, guard, {.iterations = 4}).mesh;
        auto blocked = blocked_rays(scene, smooth, margins);
        for (const auto& ray : blocked_before) {
            blocked.erase(ray);
        }
        return blocked.size();
    };
    EXPECT_GT(newly_blocked(unguarded()), 100U);
    EXPECT_EQ(newly_blocked(RayGuard(scene, half_edges(mesh))), 0U);
}

TEST(SmoothSurface, ScalesWithTheSurface)
{
    const TriMesh mesh = noisy_grid();
    TriMesh large = mesh;
    for (Vector3d& position : large.positions) {
        position *= 1024.0;
    }
    const RayGuard guard = unguarded();
    const TriMesh expected = smoothed(mesh, guard, {.iterations = 2}).mesh;
    const TriMesh smooth = smoothed(large, guard, {.iterations = 2}).mesh;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        EXPECT_EQ(smooth.positions[v], expected.positions[v] * 1024.0);
    }
}

} // namespace
} // namespace vcarve::smooth_test
