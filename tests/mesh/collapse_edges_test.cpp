#include "compare/reference.h"
#include "geometry/triangle_tree.h"
#include "mesh/collapse_edges.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace vcarve::collapse_edges_test {
namespace {

/// A flat grid of unit squares with two faces each, whose vertices have points.
TriMesh flat(std::uint32_t squares = 20)
{
    TriMesh mesh;
    const std::uint32_t side = squares + 1;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            mesh.positions.emplace_back(x, y, 0.0);
            mesh.points.push_back(1000 + side * y + x);
        }
    }
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = side * y + x;
            mesh.faces.push_back({a, a + 1, a + side});
            mesh.faces.push_back({a + 1, a + side + 1, a + side});
        }
    }
    return mesh;
}

TEST(CollapseEdges, SimplifiesFlatMeshAndKeepsItsPoints)
{
    const TriMesh mesh = flat();
    const TriMesh coarse = collapse_edges(mesh, {.max_distance = 0.01});
    EXPECT_LE(coarse.faces.size(), 40U);
    ASSERT_EQ(coarse.points.size(), coarse.positions.size());
    for (std::size_t i = 0; i < coarse.points.size(); ++i) {
        EXPECT_EQ(coarse.positions[i], mesh.positions[coarse.points[i] - 1000]);
    }
}

TEST(CollapseEdges, SimplifiesTheBoundariesBetweenPartsOfALargeMesh)
{
    const TriMesh mesh = flat(350);
    const auto on_threads = [&](int threads) {
        TriMesh coarse;
        tbb::task_arena arena(threads);
        arena.execute([&] { coarse = collapse_edges(mesh, {.max_distance = 0.01}); });
        return coarse;
    };
    const TriMesh coarse = on_threads(2);
    EXPECT_LE(coarse.faces.size(), 40U);
    EXPECT_EQ(coarse.faces, on_threads(1).faces);
    EXPECT_EQ(coarse.positions, on_threads(1).positions);
}

TEST(CollapseEdges, KeepsBumpsAboveMaxDistance)
{
    TriMesh mesh = flat();
    mesh.positions[220].z() = 2.0; // at the center
    const auto top = [](const TriMesh& each) {
        double height = 0.0;
        for (const Eigen::Vector3d& position : each.positions) {
            height = std::max(height, position.z());
        }
        return height;
    };
    EXPECT_EQ(top(collapse_edges(mesh, {.max_distance = 0.1})), 2.0);
    EXPECT_EQ(top(collapse_edges(mesh, {.max_distance = 100.0})), 0.0);
}

/// The sheet with bumps, and noise up to `noise` in all directions.
TriMesh bumpy(std::uint32_t squares, double noise)
{
    TriMesh mesh = flat(squares);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> moved(-noise, noise);
    for (Eigen::Vector3d& position : mesh.positions) {
        position.z() = 3.0 * std::sin(position.x() / 15.0) * std::cos(position.y() / 20.0);
        position += Eigen::Vector3d(moved(random), moved(random), moved(random));
    }
    return mesh;
}

/// Distances of a mesh's vertices to its simplification, in units of `max_distance`, ascending.
std::vector<double> distances_after(const TriMesh& mesh, const CollapseLimits& limits)
{
    const TriMesh coarse = collapse_edges(mesh, limits);
    EXPECT_LT(coarse.faces.size(), mesh.faces.size() / 2);
    std::vector<double> distances = distances_to(TriangleTree(coarse), mesh.positions);
    for (double& distance : distances) {
        distance /= limits.max_distance;
    }
    std::ranges::sort(distances);
    return distances;
}

TEST(CollapseEdges, MovesTheSurfaceAsItsHeaderSays)
{
    for (const double noise : {0.0, 0.2}) {
        const std::vector<double> distances =
            distances_after(bumpy(350, noise), {.max_distance = 0.25});
        double sum_sq = 0.0;
        for (const double distance : distances) {
            sum_sq += distance * distance;
        }
        const auto count = static_cast<double>(distances.size());
        EXPECT_LT(std::sqrt(sum_sq / count), 0.6) << noise;
        EXPECT_LT(distances[distances.size() * 97 / 100], 1.0) << noise;
        EXPECT_LT(distances.back(), 4.0) << noise;
    }
}

TEST(CollapseEdges, StopsAtMinFaces)
{
    const TriMesh coarse = collapse_edges(flat(), {.min_faces = 400});
    EXPECT_LE(coarse.faces.size(), 400U);
    EXPECT_GT(coarse.faces.size(), 350U);
}

TEST(RemoveFolds, RemovesPairsOfOppositeFaces)
{
    std::vector<Face> faces = {{0, 1, 2}, {5, 3, 4}, {1, 3, 2}, {3, 5, 4}};
    remove_folds(faces);
    EXPECT_EQ(faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
    std::vector<Face> all = {{0, 1, 2}, {0, 2, 1}};
    remove_folds(all);
    EXPECT_EQ(all.size(), 2U) << "no face would remain";
}

TEST(CollapseEdges, AcceptsAMeshWithoutFaces)
{
    EXPECT_TRUE(collapse_edges({}, {.max_distance = 1.0}).faces.empty());
}

} // namespace
} // namespace vcarve::collapse_edges_test
