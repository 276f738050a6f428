#include "steps/4_visibility/walk.h"
#include "support/exact_ray.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vcarve::walk_test {
namespace {

using Eigen::Vector3d;

using CellAndSlot = std::pair<Index, int>;

/// The facets that the fast walk crosses.
struct FastWalk {
    std::vector<CellAndSlot> crossed;
    WalkEnds ends;
};

std::vector<CellAndSlot> pairs(const std::vector<CellFacet>& facets)
{
    std::vector<CellAndSlot> result;
    for (const CellFacet& facet : facets) {
        result.emplace_back(facet.cell, facet.slot);
    }
    return result;
}

std::string fault_of_walk(const TetMesh& mesh, Index vertex, const Vector3d& target,
                          const FastWalk& walk)
{
    std::vector<CellFacet> facets;
    for (const auto& [cell, slot] : walk.crossed) {
        facets.push_back({cell, slot});
    }
    return fault_of_walk(mesh, vertex, target, facets, walk.ends);
}

/// Maps infinite cells to kInfinite: a ray from a hull vertex may enter any of them.
Index finite_or_none(const TetMesh& mesh, Index cell)
{
    return cell == kInfinite || mesh.cells[cell].is_infinite() ? kInfinite : cell;
}

FastWalk fast_walk(RayWalk& walk, const Vector3d& target)
{
    FastWalk result;
    result.ends =
        walk.to(target, [&](Index cell, int slot) { result.crossed.emplace_back(cell, slot); });
    return result;
}

std::string place(const NamedCells& named, Index vertex, const Vector3d& target)
{
    return named.name + ", from vertex " + std::to_string(vertex) + " to (" +
           std::to_string(target.x()) + " " + std::to_string(target.y()) + " " +
           std::to_string(target.z()) + ")";
}

// ---- RayFrame ---------------------------------------------------------------------------------

TEST(RayFrame, ProjectsTheTargetToTheOriginAtDepthOne)
{
    const RayFrame frame({1, 2, 3}, {5, 1, 4});
    const Rayed target = frame.project({5, 1, 4});
    EXPECT_EQ(target.x, 0.0);
    EXPECT_EQ(target.y, 0.0);
    EXPECT_EQ(target.depth, 1.0);
    EXPECT_EQ(target.size, 4.0);
}

TEST(RayFrame, TurnsPositiveIfTheRayPassesLeftOfAnEdge)
{
    // Seen from above, x points right and y up.
    const RayFrame down({0, 0, 4}, {0, 0, 0});
    const auto turn = [&](const Vector3d& a, const Vector3d& b) {
        return down.turn(down.project(a), down.project(b), a, b);
    };
    EXPECT_EQ(turn({1, -1, 0}, {1, 1, 0}), 1);
    EXPECT_EQ(turn({1, 1, 0}, {1, -1, 0}), -1);
    EXPECT_EQ(turn({1, 1, 0}, {-1, -1, 2}), 0);
}

TEST(RayFrame, IsUnclearIfADeterminantOverflows)
{
    // Infinity minus infinity is NaN, and all comparisons with NaN are false.
    const RayFrame frame({0, 0, 0}, {0, 0, 1e160});
    const std::array<Rayed, 3> from = {frame.project({1e160, 1e160, 0}),
                                       frame.project({-1e160, 1e160, 0}),
                                       frame.project({0, -1e160, 0})};
    EXPECT_LT(frame.clear_turns(from, frame.project({1e160, 1e160, 1e160})), 0);
    const std::array<Rayed, 3> near = {frame.project({1, 1, 0}), frame.project({-1, 1, 0}),
                                       frame.project({0, -1, 0})};
    EXPECT_GE(frame.clear_turns(near, frame.project({0.5, 2, 1})), 0);
}

TEST(RayFrame, MatchesTheExactPredicate)
{
    std::mt19937_64 random(21);
    for (const NamedCells& named : meshes_to_walk()) {
        const Positions& points = named.mesh.positions;
        for (int round = 0; round < 2000; ++round) {
            const auto vertex = static_cast<Index>(pick(random, points.size()));
            const Vector3d target = any_target(named, vertex, random);
            if (target == points[vertex]) {
                continue;
            }
            const RayFrame frame(points[vertex], target);
            const Vector3d& a = points[pick(random, points.size())];
            const Vector3d& b = points[pick(random, points.size())];
            ASSERT_EQ(frame.turn(frame.project(a), frame.project(b), a, b),
                      -orientation(points[vertex], target, a, b))
                << place(named, vertex, target);
        }
    }
}

// ---- RayWalk ----------------------------------------------------------------------------------

TEST(RayWalk, MatchesBruteForce)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(12);
        for (int round = 0; round < 90; ++round) {
            const auto vertex = static_cast<Index>(pick(random, named.mesh.positions.size()));
            RayWalk walk(named.mesh, vertex);
            for (int ray = 0; ray < 10; ++ray) {
                const Vector3d target = any_target(named, vertex, random);
                const FastWalk found = fast_walk(walk, target);
                ASSERT_EQ(fault_of_walk(named.mesh, vertex, target, found), "")
                    << place(named, vertex, target);
                ASSERT_EQ(walk.first_cell(target), found.ends.first)
                    << place(named, vertex, target);
            }
        }
    }
}

TEST(RayWalk, MatchesTheExactWalk)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(13);
        for (int round = 0; round < 5000; ++round) {
            const auto vertex = static_cast<Index>(pick(random, named.mesh.positions.size()));
            const Vector3d target = any_target(named, vertex, random);
            RayWalk walk(named.mesh, vertex);
            const auto [crossed, ends] = fast_walk(walk, target);
            ExactWalk exact(named.mesh, named.mesh.positions[vertex], target);
            const WalkEnds exact_ends = exact.from_vertex(vertex);
            ASSERT_EQ(ends.first, exact_ends.first) << place(named, vertex, target);
            ASSERT_EQ(finite_or_none(named.mesh, ends.last),
                      finite_or_none(named.mesh, exact_ends.last))
                << place(named, vertex, target);
            ASSERT_EQ(crossed, pairs(exact.crossed())) << place(named, vertex, target);
        }
    }
}

TEST(RayWalk, CrossesTheSameFacetsInterleavedAsAlone)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(16);
        std::vector<Ray> rays;
        while (rays.size() < 1000) {
            const auto vertex = static_cast<Index>(pick(random, named.mesh.positions.size()));
            for (std::size_t of_vertex = pick(random, 6); of_vertex > 0; --of_vertex) {
                rays.push_back({vertex, any_target(named, vertex, random)});
            }
        }
        std::vector<FastWalk> found(rays.size());
        std::vector<int> ended(rays.size(), 0);
        RayWalk(named.mesh)
            .along_each(
                rays.size(), [&](std::size_t k) { return rays[k]; },
                [&](std::size_t k, Index cell, int slot) {
                    found[k].crossed.emplace_back(cell, slot);
                    return true;
                },
                [&](std::size_t k, const WalkEnds& ends) {
                    found[k].ends = ends;
                    ++ended[k];
                });
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const auto& [vertex, target] = rays[k];
            RayWalk walk(named.mesh, vertex);
            const FastWalk alone = fast_walk(walk, target);
            ASSERT_EQ(ended[k], 1) << place(named, vertex, target);
            ASSERT_EQ(found[k].crossed, alone.crossed) << place(named, vertex, target);
            ASSERT_EQ(found[k].ends.first, alone.ends.first) << place(named, vertex, target);
            ASSERT_EQ(finite_or_none(named.mesh, found[k].ends.last),
                      finite_or_none(named.mesh, alone.ends.last))
                << place(named, vertex, target);
        }
    }
}

TEST(RayWalk, DoesNotDependOnPreviousWalks)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(14);
        const auto vertex = static_cast<Index>(pick(random, named.mesh.positions.size()));
        RayWalk worn(named.mesh, vertex);
        for (int ray = 0; ray < 500; ++ray) {
            const Vector3d target = any_target(named, vertex, random);
            RayWalk fresh(named.mesh, vertex);
            const FastWalk a = fast_walk(worn, target);
            const FastWalk b = fast_walk(fresh, target);
            ASSERT_EQ(a.crossed, b.crossed) << place(named, vertex, target);
            ASSERT_EQ(a.ends.first, b.ends.first) << place(named, vertex, target);
            ASSERT_EQ(finite_or_none(named.mesh, a.ends.last),
                      finite_or_none(named.mesh, b.ends.last))
                << place(named, vertex, target);
        }
    }
}

TEST(RayWalk, EndsInACellAtTheVertexIfTheTargetIsTheVertex)
{
    const TetMesh mesh = triangulation_of(random_points(50, 16));
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        RayWalk walk(mesh, vertex);
        const auto [crossed, ends] = fast_walk(walk, mesh.positions[vertex]);
        EXPECT_EQ(crossed.size(), 0U);
        EXPECT_EQ(ends.first, kInfinite);
        EXPECT_TRUE(holds(mesh, ends.last, mesh.positions[vertex]));
    }
}

TEST(RayWalk, ReachesATargetAtATinyDistance)
{
    const Vector3d middle = Vector3d::Constant(-0.5);
    Positions random = mapped(random_points(40, 17), 1.0, middle);
    random.push_back(Vector3d::Zero());
    for (const Positions& points : {random, mapped(lattice(3), 1.0, Vector3d::Constant(-1.0)),
                                    mapped(lattice(7), 1.0, Vector3d::Constant(-3.0))}) {
        const TetMesh mesh = triangulation_of(points);
        const auto vertex = static_cast<Index>(
            std::find(points.begin(), points.end(), Vector3d::Zero()) - points.begin());
        for (const Vector3d& target :
             {Vector3d(1e-310, 3e-311, 2e-311), Vector3d(-3e-311, 2e-311, -1e-310),
              Vector3d(0, 5e-324, 0), Vector3d(-1e-300, 3e-301, 1e-301), Vector3d(1e-310, 0, 0)}) {
            RayWalk walk(mesh, vertex);
            EXPECT_EQ(fault_of_walk(mesh, vertex, target, fast_walk(walk, target)), "")
                << target.transpose();
        }
    }
}

} // namespace
} // namespace vcarve::walk_test
