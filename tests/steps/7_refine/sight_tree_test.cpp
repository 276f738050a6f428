#include "steps/7_refine/sight_tree.h"
#include "support/blocked_sights.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <span>

namespace vcarve::sight_tree_test {
namespace {

using Eigen::Vector3d;
using testing::meets;
using testing::Triangle;

std::vector<std::size_t> met_by(const SightTree& tree, const Triangle& triangle)
{
    std::vector<std::size_t> met;
    tree.visit_meeting(std::span(&triangle, 1), [&](std::size_t sight) {
        met.push_back(sight);
        return true;
    });
    return met;
}

TEST(SightTree, FindsWhatBruteForceFinds)
{
    const Scene scene = bumpy_sphere(300, 11);
    const SightTree tree(scene, std::vector<double>(scene.num_points(), 0.01));
    ASSERT_EQ(tree.size(), scene.num_sights());
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

TEST(SightTree, FindsForSomeTrianglesWhatItFindsForEach)
{
    const Scene scene = bumpy_sphere(300, 11);
    const SightTree tree(scene, std::vector<double>(scene.num_points(), 0.01));
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
        tree.visit_meeting(triangles, [&](std::size_t sight) {
            met.push_back(sight);
            return true;
        });
        ASSERT_EQ(met, std::vector(expected.begin(), expected.end())) << "round " << round;
        num_met += met.size();
    }
    EXPECT_GT(num_met, 200U);
    tree.visit_meeting({}, [](std::size_t) { return ADD_FAILURE() << "of no triangle", false; });
}

TEST(SightTree, CutsTheMarginOff)
{
    const Scene scene = make_scene({{0, 0, 4}, {0, 4, 0}}, {{{0, 0, 0}, {0, 1}}});
    const SightTree tree(scene, {1.0});
    ASSERT_EQ(tree.size(), 2U);
    EXPECT_EQ(tree[0].begin, Vector3d(0, 0, 1));
    EXPECT_EQ(tree[1].begin, Vector3d(0, 1, 0));
    EXPECT_EQ(met_by(tree, {Vector3d(-1, -1, 1), {1, -1, 1}, {0, 1, 1}}).size(), 1U);
    EXPECT_TRUE(met_by(tree, {Vector3d(-1, -1, 0.99), {1, -1, 0.99}, {0, 1, 0.99}}).empty());
    // Nothing is left of sights no longer than the margin.
    EXPECT_EQ(SightTree(scene, {4.0}).size(), 0U);
}

TEST(SightTree, StopsWhenTold)
{
    const Scene scene = bumpy_sphere(100, 3);
    const SightTree tree(scene, std::vector<double>(scene.num_points(), 0.0));
    int calls = 0;
    const Triangle everywhere = {Vector3d(-9, -9, 0.1), {9, -9, 0.1}, {0, 19, 0.1}};
    ASSERT_GT(met_by(tree, everywhere).size(), 3U);
    tree.visit_meeting(std::span(&everywhere, 1), [&](std::size_t) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
}

TEST(SightTree, FindsNothingOnALineOrAmongNoSights)
{
    const Scene scene = make_scene({{0, 0, 4}}, {{{0, 0, 0}, {0}}});
    const SightTree tree(scene, {0.0});
    EXPECT_TRUE(met_by(tree, {Vector3d(-1, 0, 1), {0, 0, 1}, {1, 0, 1}}).empty());
    const SightTree none(testing::empty_scene(), {});
    EXPECT_TRUE(met_by(none, {Vector3d(-1, -1, 1), {1, -1, 1}, {0, 1, 1}}).empty());
}

} // namespace
} // namespace vcarve::sight_tree_test
