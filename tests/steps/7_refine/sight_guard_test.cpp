#include "steps/7_refine/sight_guard.h"
#include "support/blocked_sights.h"
#include "support/half_edges.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve::sight_guard_test {
namespace {

using Eigen::Vector3d;
using testing::flat_grid;
using testing::half_edges;
using testing::Triangle;

/// A grid of 3 x 3 points at the vertices of flat_grid(3), half a unit apart; one view above all.
Scene grid_seen_from_above()
{
    std::vector<MadePoint> points;
    for (const Vector3d& position : flat_grid(3).positions) {
        points.push_back({position, {0}});
    }
    return make_scene({{0.5, 0.5, 10}}, points);
}

/// A triangle over the middle of the square.
Triangle lid(double height)
{
    return {Vector3d(0.4, 0.4, height), {0.6, 0.4, height}, {0.5, 0.6, height}};
}

TEST(SightGuard, GuardsSightsBeyondTheSpacingOfTheirPoint)
{
    const SightGuard guard(grid_seen_from_above(), half_edges(flat_grid(3)));
    EXPECT_EQ(guard.num_sights(), 9);
    EXPECT_EQ(guard.num_free(), 9);
    EXPECT_TRUE(guard.blocks(lid(0.51)));
    EXPECT_TRUE(guard.blocks(lid(9.9)));
    EXPECT_FALSE(guard.blocks(lid(0.49)));
    EXPECT_FALSE(guard.blocks(lid(-0.1)));
    EXPECT_FALSE(guard.blocks({Vector3d(0.6, 0.4, 1), {0.8, 0.4, 1}, {0.7, 0.6, 1}}));
}

TEST(SightGuard, LeavesToTheirFateSightsThatAreBlockedAlready)
{
    TriMesh mesh = flat_grid(3);
    for (const Vector3d& corner : lid(5)) {
        mesh.positions.push_back(corner);
        mesh.points.push_back(kNoPoint);
    }
    mesh.faces.push_back({9, 10, 11});
    const SightGuard guard(grid_seen_from_above(), half_edges(mesh));
    // Halfway up, the sights of the neighbours are a quarter of a unit off the middle one.
    EXPECT_EQ(guard.num_free(), 8);
    EXPECT_FALSE(guard.blocks(lid(0.51)));
    EXPECT_TRUE(guard.blocks({Vector3d(0, 0, 1), {1, 0, 1}, {0.5, 1, 1}}));
}

TEST(SightGuard, GuardsAPointOffTheSurfaceToItsVeryEnd)
{
    Scene scene = make_scene({{0.5, 0.5, 10}}, {{{0.5, 0.5, 0.25}, {0}}});
    TriMesh mesh = flat_grid(3);
    mesh.points.assign(mesh.points.size(), kNoPoint);
    const SightGuard guard(scene, half_edges(mesh));
    EXPECT_TRUE(guard.blocks(lid(0.26)));
    EXPECT_TRUE(guard.blocks(lid(0.25)));
    EXPECT_FALSE(guard.blocks(lid(0.24)));
}

TEST(SightGuard, FindsTheFreeSightsThatBruteForceFinds)
{
    const Scene scene = bumpy_sphere(200, 9);
    // Any mesh will do: faces between points that have nothing to do with each other.
    TriMesh mesh;
    mesh.positions = scene.positions;
    for (std::uint32_t v = 0; v < 200; ++v) {
        mesh.positions[v] *= 1.5;
        mesh.points.push_back(v % 2 == 0 ? v : kNoPoint);
        mesh.faces.push_back({v, (v * 7 + 1) % 200, (v * 13 + 5) % 200});
    }
    const HalfEdgeMesh surface = half_edges(mesh);
    mesh = tri_mesh(surface); // has copies of vertices
    const SightGuard guard(scene, surface);
    const auto margins = testing::margins_in(mesh, scene);
    const auto blocked = testing::blocked_sights(scene, mesh, margins);
    EXPECT_GT(blocked.size(), 20U);
    EXPECT_EQ(guard.num_sights() - guard.num_free(), static_cast<std::int64_t>(blocked.size()));
}

TEST(VertexSpacings, AreMedianEdgeLengths)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-8, 0, 0}, {5, 5, 5}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<double> spacings = vertex_spacings(half_edges(mesh));
    EXPECT_EQ(spacings[0], 2.0); // of 1, 2 (twice) and 8
    EXPECT_EQ(spacings[4], 0.0); // of no face
}

} // namespace
} // namespace vcarve::sight_guard_test
