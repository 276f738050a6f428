#include "geometry/predicates.h"
#include "steps/4_visibility/view_walk.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vcarve::view_walk_test {
namespace {

using Eigen::Vector3d;

/// The facets that a line crosses, by the walk; nothing if the line could not be followed.
std::optional<std::vector<CellFacet>> walked(const TetMesh& mesh, const Vector3d& eye,
                                             const Vector3d& direction, double reach)
{
    std::vector<CellFacet> crossed;
    const bool is_followed =
        ViewWalk(mesh, eye, 0).along(direction, reach, [&](const CellFacet& ahead) {
            crossed.push_back(ahead);
            return true;
        });
    return is_followed ? std::optional(crossed) : std::nullopt;
}

bool is_same(const CellFacet& a, const CellFacet& b)
{
    return a.cell == b.cell && a.slot == b.slot;
}

/// The facets that a line crosses, in order, by a test of all facets: the hull facet by which it
/// enters, then the facets by which it leaves finite cells.
std::vector<CellFacet> tried(const TetMesh& mesh, const Vector3d& eye, const Vector3d& target)
{
    std::vector<std::pair<double, CellFacet>> crossed;
    const auto position = [&](const CellFacet& facet, int i) {
        return mesh.positions[mesh.cells[facet.cell].vertices[kFacetCorners[facet.slot][i]]];
    };
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4; ++slot) {
            const CellFacet facet = {cell, slot};
            if (mesh.cells[cell].is_infinite() && slot != 3) continue;
            const Vector3d a = position(facet, 0);
            const Vector3d b = position(facet, 1);
            const Vector3d c = position(facet, 2);
            if (orientation(a, b, c, eye) <= 0 || orientation(a, b, c, target) >= 0) continue;
            if (orientation(eye, target, a, b) >= 0 || orientation(eye, target, b, c) >= 0 ||
                orientation(eye, target, c, a) >= 0)
                continue;
            const Vector3d normal = (b - a).cross(c - a);
            crossed.emplace_back(normal.dot(a - eye) / normal.dot(target - eye), facet);
        }
    }
    std::ranges::sort(crossed, {}, &std::pair<double, CellFacet>::first);
    std::vector<CellFacet> facets;
    for (const auto& [share, facet] : crossed) {
        facets.push_back(facet);
    }
    return facets;
}

TEST(ViewWalk, MatchesBruteForce)
{
    constexpr double kReach = 40.0;
    const TetMesh mesh = triangulation_of(random_points(60, 5));
    std::mt19937_64 random(3);
    int crossing = 0;
    int followed = 0;
    for (int i = 0; i < 2000; ++i) {
        // Half of the eyes are inside the cube of the points, and most others outside.
        const double size = i % 2 == 0 ? 0.0 : 3.0;
        const Vector3d eye = even_in_cube(random, -size, 1.0 + size);
        const Vector3d aim = even_in_cube(random, -0.5, 1.5);
        const Vector3d direction = (aim - eye).normalized();
        const auto by_walk = walked(mesh, eye, direction, kReach);
        if (!by_walk) continue;
        ++followed;
        const std::vector<CellFacet> by_trying = tried(mesh, eye, eye + kReach * direction);
        ASSERT_TRUE(std::ranges::equal(*by_walk, by_trying, is_same)) << i;
        crossing += by_trying.empty() ? 0 : 1;
    }
    EXPECT_EQ(followed, 2000);
    EXPECT_GT(crossing, 1000);
    EXPECT_LT(crossing, 1990) << "some lines must miss the hull";
}

TEST(ViewWalk, StopsIfTheCallbackReturnsFalse)
{
    const TetMesh mesh = triangulation_of(random_points(60, 5));
    int asked = 0;
    const Vector3d direction = Vector3d(1.0, 0.1, 0.2).normalized();
    EXPECT_TRUE(ViewWalk(mesh, {-2.0, 0.3, 0.2}, 7).along(direction, 10.0, [&](const CellFacet&) {
        return ++asked < 3;
    }));
    EXPECT_EQ(asked, 3);
}

TEST(ViewWalk, DoesNotFollowALineThatEntersTheHullThroughAnEdge)
{
    const TetMesh mesh = triangulation_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
    const auto never = [](const CellFacet&) -> bool { throw std::logic_error("crossed"); };
    // The line enters through the edge from (0, 0, 0) to (2, 0, 0).
    EXPECT_FALSE(ViewWalk(mesh, {0.5, -1, -1}, 3).along(Vector3d(0, 1, 1).normalized(), 9, never));
    EXPECT_TRUE(ViewWalk(mesh, {0.5, -1, -1}, 3).along(Vector3d(0, -1, -1).normalized(), 9, never));
}

} // namespace
} // namespace vcarve::view_walk_test
