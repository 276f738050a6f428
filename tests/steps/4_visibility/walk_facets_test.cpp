#include "steps/4_visibility/walk.h"
#include "support/exact_ray.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

namespace vcarve::walk_facets_test {
namespace {

using Eigen::Vector3d;
using CellAndSlot = std::pair<Index, int>;

/// A segment from a position on a facet to a target.
struct Way {
    CellFacet facet;
    Vector3d place;
    Vector3d target;
};

/// The facets that a walk passed to the callback, and the facet at which it stopped.
struct FacetWalk {
    std::vector<CellAndSlot> asked;
    CellAndSlot stopped;
};

constexpr std::size_t kNever = 1'000'000;

CellAndSlot pair_of(const CellFacet& facet)
{
    return {facet.cell, facet.slot};
}

/// Walks, and returns false from call `stop_at` of the callback, counted from 0.
FacetWalk walked(const TetMesh& mesh, const Way& way, std::size_t stop_at)
{
    FacetWalk walk;
    const CellFacet stopped =
        RayWalk(mesh).through_facet(way.facet, way.place, way.target, [&](const CellFacet& f) {
            walk.asked.push_back(pair_of(f));
            return walk.asked.size() != stop_at + 1;
        });
    walk.stopped = pair_of(stopped);
    return walk;
}

std::vector<CellAndSlot> expected(const TetMesh& mesh, const Way& way)
{
    std::vector<CellAndSlot> crossed;
    for (const CellFacet& f : crossings_by_brute_force(mesh, way.facet, way.place, way.target)) {
        crossed.push_back(pair_of(f));
    }
    return crossed;
}

std::array<Vector3d, 3> corners_of(const TetMesh& mesh, const CellFacet& facet)
{
    const auto& vertices = mesh.cells[facet.cell].vertices;
    const auto& [a, b, c] = kFacetCorners[facet.slot];
    return {mesh.positions[vertices[a]], mesh.positions[vertices[b]], mesh.positions[vertices[c]]};
}

/// The position in a facet's plane with barycentric coordinates u and v, rounded.
Vector3d mixed(const TetMesh& mesh, const CellFacet& facet, double u, double v)
{
    const auto [a, b, c] = corners_of(mesh, facet);
    return u * a + v * b + (1.0 - u - v) * c;
}

int side_of(const TetMesh& mesh, const CellFacet& facet, const Vector3d& point)
{
    const auto [a, b, c] = corners_of(mesh, facet);
    return orientation(a, b, c, point);
}

CellFacet any_facet(const TetMesh& mesh, std::mt19937_64& random)
{
    CellFacet facet{};
    do {
        facet = {static_cast<Index>(pick(random, mesh.cells.size())),
                 static_cast<int>(pick(random, 4))};
    } while (mesh.cells[facet.cell].is_infinite());
    return facet;
}

/// A segment from a random position on a random facet to a random target. Half of the positions
/// have quarters as coordinates, exact on a lattice. The target is mostly beyond the facet.
Way any_way(const NamedCells& named, std::mt19937_64& random)
{
    Way way{};
    way.facet = any_facet(named.mesh, random);
    const double u = even(random, 0.02, 0.49);
    const double v = even(random, 0.02, 0.49);
    const bool is_exact = pick(random, 2) == 0;
    way.place = is_exact ? mixed(named.mesh, way.facet, 0.25, 0.25 * (1.0 + (u > 0.25 ? 1.0 : 0.0)))
                         : mixed(named.mesh, way.facet, u, v);
    const Index corner = named.mesh.cells[way.facet.cell].vertices[pick(random, 4)];
    way.target = any_target(named, corner, random);
    if (pick(random, 3) == 0) way.target += way.target - way.place;
    const bool turns = pick(random, 8) > 0 && side_of(named.mesh, way.facet, way.target) > 0;
    if (turns) way.facet = named.mesh.other_side(way.facet);
    return way;
}

TEST(FacetWalk, MatchesBruteForce)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(31);
        for (int round = 0; round < 200; ++round) {
            const Way way = any_way(named, random);
            const auto crossed = expected(named.mesh, way);
            const FacetWalk walk = walked(named.mesh, way, kNever);
            ASSERT_EQ(walk.asked, crossed) << named.name << ", round " << round;
            const CellAndSlot end =
                crossed.empty() ? pair_of(way.facet) : CellAndSlot(kInfinite, walk.stopped.second);
            ASSERT_EQ(walk.stopped, end) << named.name << ", round " << round;
        }
    }
}

TEST(FacetWalk, StopsAtTheRejectedFacet)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(32);
        for (int round = 0; round < 100; ++round) {
            const Way way = any_way(named, random);
            auto crossed = expected(named.mesh, way);
            if (crossed.empty()) continue;
            const std::size_t stop_at = pick(random, crossed.size());
            crossed.resize(stop_at + 1);
            const FacetWalk walk = walked(named.mesh, way, stop_at);
            ASSERT_EQ(walk.asked, crossed) << named.name << ", round " << round;
            ASSERT_EQ(walk.stopped, crossed.back()) << named.name << ", round " << round;
        }
    }
}

TEST(FacetWalk, CrossesNothingFromAPositionOutsideTheFacet)
{
    const TetMesh mesh = triangulation_of(random_points(60, 33));
    std::mt19937_64 random(33);
    for (int round = 0; round < 300; ++round) {
        const CellFacet facet = any_facet(mesh, random);
        const auto [a, b, c] = corners_of(mesh, facet);
        const Vector3d out = (c - a).cross(b - a).normalized();
        const Vector3d inside = mixed(mesh, facet, 0.3, 0.3);
        const Vector3d beside = mixed(mesh, facet, 0.7, 0.7);
        for (const Way& way : {Way{facet, beside, beside + out}, Way{facet, inside, inside - out},
                               Way{facet, inside, a}, Way{facet, a, a + out}}) {
            const FacetWalk walk = walked(mesh, way, kNever);
            ASSERT_TRUE(walk.asked.empty());
            ASSERT_EQ(walk.stopped, pair_of(facet));
        }
    }
}

TEST(FacetWalk, CrossesOnlyTheGivenFacetIfTheTargetIsInTheNextCell)
{
    for (const NamedCells& named : {meshes_to_walk()[0], meshes_to_walk()[2]}) {
        std::mt19937_64 random(34);
        for (int round = 0; round < 300; ++round) {
            const CellFacet facet = any_facet(named.mesh, random);
            const Vector3d place = mixed(named.mesh, facet, 0.25, 0.5);
            const CellFacet beyond = named.mesh.other_side(facet);
            Vector3d target =
                place -
                1e-3 * (named.mesh.positions[named.mesh.cells[facet.cell].vertices[facet.slot]] -
                        place);
            if (!named.mesh.cells[beyond.cell].is_infinite()) {
                const Index tip = named.mesh.cells[beyond.cell].vertices[beyond.slot];
                target = 0.5 * (place + named.mesh.positions[tip]);
            }
            const FacetWalk walk = walked(named.mesh, {facet, place, target}, kNever);
            ASSERT_EQ(walk.asked, std::vector<CellAndSlot>{pair_of(facet)}) << named.name;
            ASSERT_EQ(walk.stopped.first, kInfinite) << named.name;
        }
    }
}

TEST(FacetWalk, EntersTheHullThroughAnInfiniteCell)
{
    const TetMesh mesh = triangulation_of(random_points(60, 35));
    int entered = 0;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (!mesh.cells[cell].is_infinite()) continue;
        const Way way{{cell, 3}, mixed(mesh, {cell, 3}, 0.3, 0.4), {0.47, 0.52, 0.49}};
        const FacetWalk walk = walked(mesh, way, kNever);
        ASSERT_EQ(walk.asked, expected(mesh, way));
        ASSERT_EQ(walk.asked.front(), CellAndSlot(cell, 3));
        ++entered;
    }
    EXPECT_GT(entered, 0);
}

} // namespace
} // namespace vcarve::walk_facets_test
