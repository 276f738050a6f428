#include "baselines/alpha_shape.h"
#include "steps/3_cells/triangulate.h"
#include "support/random_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace vcarve::alpha_shape_test {
namespace {

TetMesh one_cell(const Eigen::Vector3d& fourth)
{
    TetMesh cells;
    cells.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, fourth};
    cells.cells = {{.vertices = {0, 1, 2, 3}, .neighbors = {1, 1, 1, 1}},
                   {.vertices = {0, 1, 2, kInfinite}, .neighbors = {0, 0, 0, 0}}};
    return cells;
}

TEST(Circumsphere, OfACubeCornerIsCenteredInTheCube)
{
    const Circumsphere sphere = circumsphere(one_cell({0, 0, 2}), 0);
    EXPECT_TRUE(sphere.center.isApprox(Eigen::Vector3d(1, 1, 1)));
    EXPECT_DOUBLE_EQ(sphere.radius, std::sqrt(3.0));
}

TEST(Circumsphere, IsInfiniteForFlatAndInfiniteCells)
{
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(circumsphere(one_cell({5, 3, 0}), 0).radius, infinity);
    EXPECT_EQ(circumsphere(one_cell({0, 0, 2}), 1).radius, infinity);
}

TEST(Circumsphere, PassesThroughTheCornersAndContainsNoOtherPoint)
{
    const TetMesh cells = triangulate(testing::random_points(60, 1));
    for (Index cell = 0; cell < cells.cells.size(); ++cell) {
        if (cells.cells[cell].is_infinite()) continue;
        const Circumsphere sphere = circumsphere(cells, cell);
        const double tolerance = 1e-7 * sphere.radius;
        for (const Index corner : cells.cells[cell].vertices) {
            const double distance = (cells.positions[corner] - sphere.center).norm();
            EXPECT_NEAR(distance, sphere.radius, tolerance);
        }
        for (const Eigen::Vector3d& position : cells.positions) {
            EXPECT_GE((position - sphere.center).norm(), sphere.radius - tolerance);
        }
    }
}

/// Whether every point is a corner of an inside cell and the inside cells are connected.
bool is_whole(const TetMesh& cells, const Labels& labels)
{
    std::set<Index> corners;
    std::vector<Index> open;
    std::set<Index> reached;
    for (Index cell = 0; cell < labels.size(); ++cell) {
        if (labels[cell] == Label::outside) continue;
        corners.insert(cells.cells[cell].vertices.begin(), cells.cells[cell].vertices.end());
        if (open.empty()) open.push_back(cell);
    }
    while (!open.empty()) {
        const Index cell = open.back();
        open.pop_back();
        if (!reached.insert(cell).second) continue;
        for (const Index neighbor : cells.cells[cell].neighbors) {
            if (labels[neighbor] == Label::inside) open.push_back(neighbor);
        }
    }
    const auto inside = static_cast<std::size_t>(std::ranges::count(labels, Label::inside));
    return corners.size() == cells.positions.size() && reached.size() == inside;
}

TEST(AlphaShape, ContainsCellsWithSmallCircumspheres)
{
    const TetMesh cells = triangulate(testing::random_points(40, 2));
    const Labels labels = alpha_shape(cells, 0.3);
    for (Index cell = 0; cell < labels.size(); ++cell) {
        EXPECT_EQ(labels[cell] == Label::inside, circumsphere(cells, cell).radius <= 0.3);
    }
    EXPECT_GT(std::ranges::count(labels, Label::inside), 0);
}

TEST(AlphaShape, IsTheConvexHullForInfiniteAlpha)
{
    const TetMesh cells = triangulate(testing::random_points(40, 2));
    const Labels labels = alpha_shape(cells, std::numeric_limits<double>::infinity());
    for (Index cell = 0; cell < labels.size(); ++cell) {
        EXPECT_EQ(labels[cell] == Label::outside, cells.cells[cell].is_infinite());
    }
}

TEST(SmallestWholeAlpha, IsTheSmallestRadiusThatGivesAWholeShape)
{
    for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
        const TetMesh cells = triangulate(testing::random_points(30, seed));
        std::set<double> radii;
        for (Index cell = 0; cell < cells.cells.size(); ++cell) {
            if (!cells.cells[cell].is_infinite()) radii.insert(circumsphere(cells, cell).radius);
        }
        const auto first = std::ranges::find_if(
            radii, [&](double radius) { return is_whole(cells, alpha_shape(cells, radius)); });
        ASSERT_NE(first, radii.end());
        EXPECT_EQ(smallest_whole_alpha(cells), *first);
    }
}

TEST(SmallestWholeAlpha, BridgesTheGapBetweenTwoClouds)
{
    // Two clouds of size 1, 9 apart: the sphere of a cell across the gap is wider than half of it.
    Scene scene = testing::random_points(30, 7);
    const Scene other = testing::random_points(30, 8);
    EXPECT_LT(smallest_whole_alpha(triangulate(scene)), 4.5);
    for (std::size_t i = 0; i < 30; ++i) {
        scene.positions.push_back(other.positions[i] + Eigen::Vector3d(10, 0, 0));
        scene.colors.push_back({});
        scene.errors_px.push_back(0.0);
        scene.point_ids.push_back(31 + i);
        scene.tracks.push_back(std::vector<std::uint32_t>{});
    }
    EXPECT_GT(smallest_whole_alpha(triangulate(scene)), 4.5);
}

TEST(SmallestWholeAlpha, GrowsWithTheScene)
{
    Scene scene = testing::random_points(30, 3);
    const double alpha = smallest_whole_alpha(triangulate(scene));
    for (Eigen::Vector3d& position : scene.positions) {
        position *= 1024.0;
    }
    EXPECT_DOUBLE_EQ(smallest_whole_alpha(triangulate(scene)), 1024.0 * alpha);
}

} // namespace
} // namespace vcarve::alpha_shape_test
