#include "steps/4_visibility/nearest_points.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace vcarve {
namespace {

using Eigen::Vector3d;

std::vector<Index> by_brute_force(const TetMesh& mesh, const Vector3d& place, std::size_t count)
{
    std::vector<Index> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
        return (mesh.positions[a] - place).squaredNorm() <
               (mesh.positions[b] - place).squaredNorm();
    });
    order.resize(std::min(count, order.size()));
    return order;
}

TEST(NearestPoints, AreThoseOfBruteForceWhereverTheSearchBegins)
{
    std::mt19937_64 random(3);
    const TetMesh mesh = triangulation_of(random_points(2000, 1));
    for (int i = 0; i < 200; ++i) {
        const Vector3d place = even_in_cube(random, -0.5, 1.5); // in the hull and out of it
        const auto start = static_cast<Index>(pick(random, mesh.positions.size()));
        const std::size_t count = pick(random, 60);
        EXPECT_EQ(nearest_points(mesh, place, count, start), by_brute_force(mesh, place, count));
    }
}

TEST(NearestPoints, AreAllPointsWhereThatManyAreAskedFor)
{
    const TetMesh mesh = triangulation_of(random_points(50, 2));
    const Vector3d place(0.3, 0.4, 0.5);
    EXPECT_EQ(nearest_points(mesh, place, 50, 7), by_brute_force(mesh, place, 50));
    EXPECT_EQ(nearest_points(mesh, place, 1000, 7), by_brute_force(mesh, place, 50));
    EXPECT_EQ(nearest_points(mesh, place, 0, 7), std::vector<Index>{});
}

TEST(NearestPoints, FindsTheSmallerOfTwoAtOneDistanceFirst)
{
    // Nothing but ties: six neighbours at distance 1, twelve at the root of 2.
    const TetMesh mesh = triangulation_of(lattice(5));
    EXPECT_EQ(nearest_points(mesh, {2, 2, 2}, 19, 0), by_brute_force(mesh, {2, 2, 2}, 19));
}

} // namespace
} // namespace vcarve
