#include "steps/7_refine/ray_guard.h"
#include "support/blocked_rays.h"
#include "support/half_edges.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace vcarve::ray_guard_test {
namespace {

using Eigen::Vector3d;
using testing::flat_grid;
using testing::half_edges;
using testing::meets;
using testing::Triangle;

std::vector<std::size_t> met_by(const RayTree& tree, const Triangle& triangle)
{
    std::vector<std::size_t> met;
    tree.visit_meeting(std::span(&triangle, 1), [&](std::size_t ray) {
        met.push_back(ray);
        return true;
    });
    return met;
}

TEST(RayTree, MatchesBruteForce)
{
    const Scene scene = bumpy_sphere(300, 11);
    const RayTree tree(scene, std::vector<double>(scene.num_points(), 0.01));
    ASSERT_EQ(tree.size(), scene.num_rays());
    std::mt19937 random(5);
    const auto anywhere = [&] {
        const auto number = [&] { return random() / 2147483648.0 - 1.0; };
        return Vector3d{number(), number(), number()};
    };
    std::size_t num_met = 0;
    for (int round = 0; round < 600; ++round) {
        const double size = std::pow(0.5, round % 6);
        const Vector3d place = 2.0 * anywhere();
        const Triangle triangle = {place, place + size * anywhere(), place + size * anywhere()};
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < tree.size(); ++i) {
            const Vector3d& end = scene.views[tree[i].view].center;
            if (meets(triangle, tree[i].begin, end)) expected.push_back(i);
        }
        ASSERT_EQ(met_by(tree, triangle), expected) << "round " << round;
        num_met += expected.size();
    }
    EXPECT_GT(num_met, 400U);
}

TEST(RayTree, FindsTheSameForManyTrianglesAsForEach)
{
    const Scene scene = bumpy_sphere(300, 11);
    const RayTree tree(scene, std::vector<double>(scene.num_points(), 0.01));
    std::mt19937 random(7);
    const auto anywhere = [&] {
        const auto number = [&] { return random() / 2147483648.0 - 1.0; };
        return Vector3d{number(), number(), number()};
    };
    std::size_t num_met = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Triangle> triangles(1 + round % 5);
        const Vector3d place = 2.0 * anywhere();
        std::set<std::size_t> expected;
        for (Triangle& triangle : triangles) {
            triangle = {place, place + 0.3 * anywhere(), place + 0.3 * anywhere()};
            const std::vector<std::size_t> met = met_by(tree, triangle);
            expected.insert(met.begin(), met.end());
        }
        std::vector<std::size_t> met;
        tree.visit_meeting(triangles, [&](std::size_t ray) {
            met.push_back(ray);
            return true;
        });
        ASSERT_EQ(met, std::vector(expected.begin(), expected.end())) << "round " << round;
        num_met += met.size();
    }
    EXPECT_GT(num_met, 200U);
    tree.visit_meeting({}, [](std::size_t) { return ADD_FAILURE() << "no triangle", false; });
}

TEST(RayTree, CutsTheMarginOff)
{
    const Scene scene = make_scene({{0, 0, 4}, {0, 4, 0}}, {{{0, 0, 0}, {0, 1}}});
    const RayTree tree(scene, {1.0});
    ASSERT_EQ(tree.size(), 2U);
    EXPECT_EQ(tree[0].begin, Vector3d(0, 0, 1));
    EXPECT_EQ(tree[1].begin, Vector3d(0, 1, 0));
    EXPECT_EQ(met_by(tree, {Vector3d(-1, -1, 1), {1, -1, 1}, {0, 1, 1}}).size(), 1U);
    EXPECT_TRUE(met_by(tree, {Vector3d(-1, -1, 0.99), {1, -1, 0.99}, {0, 1, 0.99}}).empty());
    // Rays not longer than the margin are dropped.
    EXPECT_EQ(RayTree(scene, {4.0}).size(), 0U);
}

TEST(RayTree, StopsIfTheVisitorReturnsFalse)
{
    const Scene scene = bumpy_sphere(100, 3);
    const RayTree tree(scene, std::vector<double>(scene.num_points(), 0.0));
    int calls = 0;
    const Triangle everywhere = {Vector3d(-9, -9, 0.1), {9, -9, 0.1}, {0, 19, 0.1}};
    ASSERT_GT(met_by(tree, everywhere).size(), 3U);
    tree.visit_meeting(std::span(&everywhere, 1), [&](std::size_t) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
}

TEST(RayTree, FindsNothingForCollinearTrianglesOrWithoutRays)
{
    const Scene scene = make_scene({{0, 0, 4}}, {{{0, 0, 0}, {0}}});
    const RayTree tree(scene, {0.0});
    EXPECT_TRUE(met_by(tree, {Vector3d(-1, 0, 1), {0, 0, 1}, {1, 0, 1}}).empty());
    const RayTree none(testing::empty_scene(), {});
    EXPECT_TRUE(met_by(none, {Vector3d(-1, -1, 1), {1, -1, 1}, {0, 1, 1}}).empty());
}

/// A grid of 3 x 3 points at the vertices of flat_grid(3), half a unit apart; one view above all.
Scene grid_seen_from_above()
{
    std::vector<MadePoint> points;
    for (const Vector3d& position : flat_grid(3).positions) {
        points.push_back({position, {0}});
    }
    return make_scene({{0.5, 0.5, 10}}, points);
}

/// A triangle above the center of the square.
Triangle lid(double height)
{
    return {Vector3d(0.4, 0.4, height), {0.6, 0.4, height}, {0.5, 0.6, height}};
}

bool blocks(const RayGuard& guard, const Triangle& triangle)
{
    return guard.blocks({}, std::span(&triangle, 1));
}

TEST(RayGuard, GuardsRaysBeyondTheSpacingOfTheirPoint)
{
    const RayGuard guard(grid_seen_from_above(), half_edges(flat_grid(3)));
    EXPECT_EQ(guard.num_rays(), 9);
    EXPECT_TRUE(blocks(guard, lid(0.51)));
    EXPECT_TRUE(blocks(guard, lid(9.9)));
    EXPECT_FALSE(blocks(guard, lid(0.49)));
    EXPECT_FALSE(blocks(guard, lid(-0.1)));
    EXPECT_FALSE(blocks(guard, {Vector3d(0.6, 0.4, 1), {0.8, 0.4, 1}, {0.7, 0.6, 1}}));
}

TEST(RayGuard, IgnoresRaysThatAreAlreadyBlocked)
{
    TriMesh mesh = flat_grid(3);
    for (const Vector3d& corner : lid(5)) {
        mesh.positions.push_back(corner);
        mesh.points.push_back(kNoPoint);
    }
    mesh.faces.push_back({9, 10, 11});
    const RayGuard guard(grid_seen_from_above(), half_edges(mesh));
    // At half height, the rays of the neighbors are a quarter of a unit from the central one.
    EXPECT_FALSE(blocks(guard, lid(0.51)));
    EXPECT_TRUE(blocks(guard, {Vector3d(0, 0, 1), {1, 0, 1}, {0.5, 1, 1}}));
}

TEST(RayGuard, IgnoresRaysThatTheReplacedFacesBlock)
{
    const RayGuard guard(grid_seen_from_above(), half_edges(flat_grid(3)));
    const std::vector<Triangle> before = {lid(5)};
    // At half height, the rays of the neighbors are a quarter of a unit from the central one.
    EXPECT_FALSE(guard.blocks(before, std::vector{lid(0.51)}));
    EXPECT_TRUE(
        guard.blocks(before, std::vector<Triangle>{{Vector3d(0, 0, 1), {1, 0, 1}, {0.5, 1, 1}}}));
}

TEST(RayGuard, GuardsTheWholeRayOfAPointThatIsNoVertex)
{
    Scene scene = make_scene({{0.5, 0.5, 10}}, {{{0.5, 0.5, 0.25}, {0}}});
    TriMesh mesh = flat_grid(3);
    mesh.points.assign(mesh.points.size(), kNoPoint);
    const RayGuard guard(scene, half_edges(mesh));
    EXPECT_TRUE(blocks(guard, lid(0.26)));
    EXPECT_TRUE(blocks(guard, lid(0.25)));
    EXPECT_FALSE(blocks(guard, lid(0.24)));
}

TEST(RayGuard, DecidesLikeATestOfAllRays)
{
    const Scene scene = bumpy_sphere(200, 9);
    TriMesh mesh;
    mesh.positions = scene.positions;
    mesh.points.assign(scene.num_points(), kNoPoint);
    for (std::uint32_t v = 0; v < 190; v += 10) {
        mesh.faces.push_back({v, v + 1, v + 2});
    }
    const RayGuard guard(scene, half_edges(mesh));
    std::vector<Triangle> surface;
    for (const auto& [a, b, c] : mesh.faces) {
        surface.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    }
    std::mt19937 random(5);
    const auto anywhere = [&] {
        const auto number = [&] { return random() / 2147483648.0 - 1.0; };
        return Vector3d{number(), number(), number()};
    };
    std::array<int, 2> counts{};
    for (int round = 0; round < 400; ++round) {
        const Vector3d place = 1.2 * anywhere();
        std::vector<Triangle> before(3);
        std::vector<Triangle> after(2);
        for (auto* triangles : {&before, &after}) {
            for (Triangle& t : *triangles) {
                t = {place, place + 0.5 * anywhere(), place + 0.5 * anywhere()};
            }
        }
        bool expected = false;
        for (std::size_t point = 0; point < scene.num_points(); ++point) {
            for (const std::uint32_t view : scene.tracks[point]) {
                const auto is_met = [&](const Triangle& t) {
                    return meets(t, scene.positions[point], scene.views[view].center);
                };
                expected = expected || (std::ranges::any_of(after, is_met) &&
                                        std::ranges::none_of(before, is_met) &&
                                        std::ranges::none_of(surface, is_met));
            }
        }
        EXPECT_EQ(guard.blocks(before, after), expected) << "round " << round;
        ++counts[expected ? 1 : 0];
    }
    EXPECT_GT(counts[0], 40);
    EXPECT_GT(counts[1], 40);
}

TEST(VertexSpacings, AreMedianEdgeLengths)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-8, 0, 0}, {5, 5, 5}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<double> spacings = vertex_spacings(half_edges(mesh));
    EXPECT_EQ(spacings[0], 2.0); // of 1, 2 (twice) and 8
    EXPECT_EQ(spacings[4], 0.0); // no face
}

} // namespace
} // namespace vcarve::ray_guard_test
