#include "geometry/point_tree.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace vcarve::point_tree_test {
namespace {

using Eigen::Vector3d;

TEST(PointTree, VisitsEachPointOutsideOwnRunOnceIfNothingIsSkipped)
{
    for (const std::size_t count : {1, 15, 16, 17, 129, 1000, 5000}) {
        const Positions points = random_points(count, 61);
        const PointTree tree(points);
        const PointRun own{count / 3, count / 2};
        std::vector<int> shown(count, 0);
        tree.visit_excluding(
            own, 1.0, [](const Box&) { return 0.0; }, [&](std::size_t i) { ++shown[i]; });
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(shown[i], own.contains(i) ? 0 : 1) << i << " of " << count;
        }
    }
}

TEST(PointTree, VisitsAllPointsInQueryBox)
{
    const Positions points = random_points(3000, 62);
    const PointTree tree(points);
    const Box wanted{{0.2, 0.3, 0.4}, {0.5, 0.5, 0.6}};
    const auto is_in = [&](const Vector3d& p) {
        return (p.array() >= wanted.low.array()).all() && (p.array() <= wanted.high.array()).all();
    };
    std::ptrdiff_t shown = 0;
    tree.visit_excluding(
        {0, 0}, 0.0,
        [&](const Box& box) {
            const bool meets = (box.low.array() <= wanted.high.array()).all() &&
                               (box.high.array() >= wanted.low.array()).all();
            return meets ? 0.0 : 1.0;
        },
        [&](std::size_t i) { shown += is_in(points[i]) ? 1 : 0; });
    EXPECT_EQ(shown, std::ranges::count_if(points, is_in));
    EXPECT_GT(shown, 0);
}

/// The distances from `place` to all points, ascending.
std::vector<double> distances_to(const Positions& points, const Vector3d& place)
{
    std::vector<double> distances;
    for (const Vector3d& point : points) {
        distances.push_back((point - place).norm());
    }
    std::ranges::sort(distances);
    return distances;
}

/// The distances of the points that the tree finds. Checks the distances that it returns.
std::vector<double> distances_found(const PointTree& tree, const Vector3d& place, std::size_t count)
{
    std::vector<PointTree::Near> nearest(3); // as after an earlier call
    tree.find_nearest(place, count, nearest);
    std::vector<double> found;
    for (const auto& [distance, point] : nearest) {
        found.push_back((tree.points()[point] - place).norm());
        EXPECT_EQ(distance, found.back());
    }
    return found;
}

TEST(PointTree, FindsNearestPoints)
{
    for (const std::size_t count : {0, 1, 17, 2000}) {
        const Positions points = random_points(count, 64);
        const PointTree tree(points);
        for (const Vector3d& place : random_points(20, 65)) {
            std::vector<double> expected = distances_to(points, place);
            for (const std::size_t wanted : {40, 4, 1, 0}) {
                expected.resize(std::min(wanted, count));
                EXPECT_EQ(distances_found(tree, place, wanted), expected);
            }
        }
    }
}

TEST(PointTree, BreaksTiesByIndex)
{
    // All are ties: six neighbors at distance 1, twelve at the square root of 2.
    const Positions points = lattice(5);
    const PointTree tree(points);
    std::vector<PointTree::Near> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
        expected.push_back({(points[i] - Vector3d(2, 2, 2)).norm(), i});
    }
    std::ranges::sort(expected);
    expected.resize(12);
    std::vector<PointTree::Near> nearest;
    tree.find_nearest({2, 2, 2}, 12, nearest);
    EXPECT_EQ(nearest, expected);
}

TEST(PointTree, ReturnsDistancesToNearestPointsOutsideOwnRun)
{
    const Positions points = random_points(500, 63);
    const PointTree tree(points);
    const PointRun own{100, 200}; // leaves from point 96 to 208
    const std::vector<double> distances = tree.distances_to_others(own);
    ASSERT_EQ(distances.size(), 7U);
    for (std::size_t leaf = 0; leaf < 7; ++leaf) {
        Box box{points[96 + 16 * leaf], points[96 + 16 * leaf]};
        for (std::size_t i = 0; i < 16; ++i) {
            const Vector3d& p = points[96 + 16 * leaf + i];
            box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
        }
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (own.contains(i)) continue;
            nearest = std::min(nearest,
                               (points[i].cwiseMax(box.low).cwiseMin(box.high) - points[i]).norm());
        }
        EXPECT_DOUBLE_EQ(distances[leaf], nearest) << leaf;
    }
    EXPECT_EQ(tree.distances_to_others({0, 500})[3], std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace vcarve::point_tree_test
