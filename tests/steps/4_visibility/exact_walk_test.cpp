#include "steps/4_visibility/exact_walk.h"
#include "support/exact_ray.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vcarve::exact_walk_test {
namespace {

using Eigen::Vector3d;

/// Two tetrahedra with the common triangle 0 1 2: one up to vertex 3, one down to vertex 4.
TetMesh bipyramid()
{
    return triangulation_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {1, 1, -3}});
}

Index cell_with(const TetMesh& mesh, const std::array<Index, 4>& vertices)
{
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        auto sorted = mesh.cells[cell].vertices;
        std::sort(sorted.begin(), sorted.end());
        if (sorted == vertices) {
            return cell;
        }
    }
    ADD_FAILURE() << "there is no such cell";
    return 0;
}

/// The cells that a walk left, in order, and its first and last cell.
struct Walked {
    std::vector<Index> left;
    Index first;
    Index last;
    bool operator==(const Walked&) const = default;
};

Walked walked(const TetMesh& mesh, Index vertex, const Vector3d& target)
{
    ExactWalk walk(mesh, mesh.positions[vertex], target);
    const WalkEnds ends = walk.from_vertex(vertex);
    Walked result{{}, ends.first, ends.last};
    for (const CellFacet& facet : walk.crossed()) {
        result.left.push_back(facet.cell);
    }
    return result;
}

std::ostream& operator<<(std::ostream& out, const Walked& walk)
{
    out << "from cell " << walk.first << " to " << walk.last << " leaving";
    for (const Index cell : walk.left) {
        out << ' ' << cell;
    }
    return out;
}

// ---- hand-computed cases ------------------------------------------------------------------------

TEST(ExactWalk, CrossesTheSharedFacetAndTheHullFacet)
{
    const TetMesh mesh = bipyramid();
    const Index upper = cell_with(mesh, {0, 1, 2, 3});
    const Index lower = cell_with(mesh, {0, 1, 2, 4});
    const Index past_hull = cell_with(mesh, {0, 1, 4, kInfinite});
    EXPECT_EQ(walked(mesh, 3, {1, 1, 1}), (Walked{{}, upper, upper}));
    EXPECT_EQ(walked(mesh, 3, {1, 1, -1}), (Walked{{upper}, upper, lower}));
    EXPECT_EQ(walked(mesh, 3, {1.25, -0.75, -4}), (Walked{{upper, lower}, upper, past_hull}));
}

TEST(ExactWalk, StopsBeforeTheFacetThatContainsTheTarget)
{
    const TetMesh mesh = bipyramid();
    const Index upper = cell_with(mesh, {0, 1, 2, 3});
    EXPECT_EQ(walked(mesh, 3, {1, 1, 0}), (Walked{{}, upper, upper}));
    EXPECT_EQ(walked(mesh, 4, {1, 1, 0}).left, std::vector<Index>{});
}

TEST(ExactWalk, CrossesNothingAlongAnEdgeOrInAFacet)
{
    const TetMesh mesh = bipyramid();
    const Walked along_edge = walked(mesh, 0, {2, 0, 0});
    EXPECT_EQ(along_edge.left, std::vector<Index>{});
    EXPECT_EQ(along_edge.first, kInfinite);
    EXPECT_TRUE(holds(mesh, along_edge.last, {2, 0, 0}));
    const Walked in_facet = walked(mesh, 0, {1, 1, 0});
    EXPECT_EQ(in_facet.left, std::vector<Index>{});
    EXPECT_EQ(in_facet.first, kInfinite);
    EXPECT_TRUE(holds(mesh, in_facet.last, {1, 1, 0}));
}

TEST(ExactWalk, EndsInNoCellIfItLeavesTheHullThroughAnEdgeOrVertex)
{
    const TetMesh mesh = bipyramid();
    const Index upper = cell_with(mesh, {0, 1, 2, 3});
    EXPECT_EQ(walked(mesh, 3, {0, 0, -6}), (Walked{{upper}, upper, kInfinite})); // the edge 0 4
    EXPECT_EQ(walked(mesh, 3, {1, -1, -3}), (Walked{{}, kInfinite, kInfinite})); // in a hull facet
    EXPECT_EQ(walked(mesh, 0, {8, 0, 0}), (Walked{{}, kInfinite, kInfinite}));   // past vertex 1
    EXPECT_EQ(walked(mesh, 3, {1, 1, 4}), (Walked{{}, kInfinite, kInfinite}));   // at once
}

TEST(ExactWalk, EndsAtOnceIfTheTargetIsTheVertex)
{
    const TetMesh mesh = bipyramid();
    const Walked walk = walked(mesh, 1, {4, 0, 0});
    EXPECT_EQ(walk.left, std::vector<Index>{});
    EXPECT_EQ(walk.first, kInfinite);
    EXPECT_TRUE(holds(mesh, walk.last, {4, 0, 0}));
}

TEST(ExactWalk, ContinuesFromInsideACell)
{
    const TetMesh mesh = bipyramid();
    const Index upper = cell_with(mesh, {0, 1, 2, 3});
    ExactWalk walk(mesh, {1, 1, 3}, {1, 1, -1});
    EXPECT_EQ(walk.from_cell(upper), cell_with(mesh, {0, 1, 2, 4}));
    ASSERT_EQ(walk.crossed().size(), 1U);
    EXPECT_EQ(walk.crossed()[0].cell, upper);
    EXPECT_EQ(mesh.cells[upper].vertices[walk.crossed()[0].slot], 3U);
}

TEST(CellsAroundVertex, FindsAllCellsWithTheVertex)
{
    for (const NamedCells& named : meshes_to_walk()) {
        const TetMesh& mesh = named.mesh;
        for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            std::vector<Index> expected;
            for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
                const auto& vertices = mesh.cells[cell].vertices;
                if (std::count(vertices.begin(), vertices.end(), vertex) == 1) {
                    expected.push_back(cell);
                }
            }
            auto found = cells_around_vertex(mesh, vertex, mesh.cell_of_vertex[vertex]);
            std::sort(found.begin(), found.end());
            ASSERT_EQ(found, expected) << named.name << ", vertex " << vertex;
        }
    }
}

TEST(CellsAroundVertex, FindsManyCellsAtTheCenterOfASphere)
{
    Positions points = {Vector3d::Zero()};
    for (int i = 0; i < 500; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / 500;
        points.emplace_back(std::sqrt(1.0 - z * z) * std::cos(2.4 * i),
                            std::sqrt(1.0 - z * z) * std::sin(2.4 * i), z);
    }
    const TetMesh mesh = triangulation_of(points);
    const auto middle = static_cast<Index>(
        std::ranges::find(mesh.positions, Vector3d(Vector3d::Zero())) - mesh.positions.begin());
    const auto expected = std::ranges::count_if(mesh.cells, [&](const Cell& cell) {
        return std::ranges::count(cell.vertices, middle) == 1;
    });
    auto found = cells_around_vertex(mesh, middle, mesh.cell_of_vertex[middle]);
    EXPECT_GT(expected, 900);
    EXPECT_EQ(std::ssize(found), expected);
    std::ranges::sort(found);
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
}

// ---- against brute force ------------------------------------------------------------------------

TEST(ExactWalk, MatchesBruteForce)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(11);
        for (int ray = 0; ray < 700; ++ray) {
            const auto vertex = static_cast<Index>(pick(random, named.mesh.positions.size()));
            const Vector3d target = any_target(named, vertex, random);
            ExactWalk walk(named.mesh, named.mesh.positions[vertex], target);
            const WalkEnds ends = walk.from_vertex(vertex);
            ASSERT_EQ(fault_of_walk(named.mesh, vertex, target, walk.crossed(), ends), "")
                << named.name << ", ray " << ray << " from vertex " << vertex << " to ("
                << target.transpose() << ")";
        }
    }
}

TEST(ExactWalk, ConnectsAnyTwoPointsOfALattice)
{
    const TetMesh mesh = triangulation_of(lattice(4));
    for (Index from = 0; from < mesh.positions.size(); ++from) {
        for (Index to = 0; to < mesh.positions.size(); ++to) {
            const Vector3d& target = mesh.positions[to];
            ExactWalk walk(mesh, mesh.positions[from], target);
            const WalkEnds ends = walk.from_vertex(from);
            ASSERT_EQ(fault_of_walk(mesh, from, target, walk.crossed(), ends), "")
                << "from vertex " << from << " to vertex " << to;
        }
    }
}

} // namespace
} // namespace vcarve::exact_walk_test
