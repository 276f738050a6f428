#include "base/numbers.h"
#include "geometry/predicates.h"
#include "geometry/triangle_tree.h"
#include "support/grid_faces.h"
#include "support/measured_scenes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace vcarve::triangle_tree_test {
namespace {

using testing::distance_to_face;
using testing::together;

Eigen::Vector3d random_point(std::uint64_t seed, std::uint64_t index)
{
    const Eigen::Vector3d unit(random_number(seed, 3 * index), random_number(seed, 3 * index + 1),
                               random_number(seed, 3 * index + 2));
    return 2.0 * unit - Eigen::Vector3d::Constant(0.5);
}

/// Exact if nothing is degenerate: the ends are on different sides, and the line crosses the face.
bool crosses_face(const TriMesh& mesh, const Face& face, const Eigen::Vector3d& p,
                  const Eigen::Vector3d& q)
{
    const Eigen::Vector3d& a = mesh.positions[face[0]];
    const Eigen::Vector3d& b = mesh.positions[face[1]];
    const Eigen::Vector3d& c = mesh.positions[face[2]];
    if (orientation(a, b, c, p) == orientation(a, b, c, q)) return false;
    const int side = orientation(p, q, a, b);
    return side == orientation(p, q, b, c) && side == orientation(p, q, c, a);
}

TEST(TriangleTree, ReturnsTheNearestFace)
{
    // A floor and a wall at its edge x = 1.
    TriMesh corner = testing::square();
    const auto first = static_cast<std::uint32_t>(corner.positions.size());
    corner.positions.insert(corner.positions.end(), {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}});
    corner.faces.push_back({first, first + 1, first + 2});
    const TriangleTree tree(corner);
    const NearestFace floor = tree.nearest({0.5, 0.5, 0.25});
    EXPECT_DOUBLE_EQ(floor.distance, 0.25);
    EXPECT_TRUE(floor.normal.isApprox(Eigen::Vector3d::UnitZ()));
    const NearestFace wall = tree.nearest({0.875, 0.25, 0.25});
    EXPECT_DOUBLE_EQ(wall.distance, 0.125);
    EXPECT_TRUE(wall.normal.isApprox(Eigen::Vector3d::UnitX()));
}

TEST(TriangleTree, ReturnsDistancesOfSquare)
{
    const TriangleTree tree(testing::square());
    EXPECT_DOUBLE_EQ(tree.distance({0.3, 0.6, 2.0}), 2.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.3, 0.6, -2.0}), 2.0);
    EXPECT_DOUBLE_EQ(tree.distance({4.0, 5.0, 0.0}), 5.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, -1.0, 0.0}), 1.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, 0.25, 0.0}), 0.0);
}

TEST(TriangleTree, DistancesMatchBruteForce)
{
    const TriMesh mesh = testing::random_soup(60, 11);
    const TriangleTree tree(mesh);
    for (std::uint64_t i = 0; i < 500; ++i) {
        const Eigen::Vector3d x = random_point(12, i);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Face& face : mesh.faces) {
            nearest = std::min(nearest, distance_to_face(mesh, face, x));
        }
        EXPECT_NEAR(tree.distance(x), nearest, 1e-12);
    }
}

TEST(TriangleTree, SegmentIsMetIfItCrossesAnyFace)
{
    const TriMesh mesh = testing::random_soup(12, 13);
    const TriangleTree tree(mesh);
    int blocked = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const Eigen::Vector3d p = random_point(14, 2 * i);
        const Eigen::Vector3d q = random_point(14, 2 * i + 1);
        const bool crossed = std::ranges::any_of(
            mesh.faces, [&](const Face& face) { return crosses_face(mesh, face, p, q); });
        EXPECT_EQ(tree.is_met(p, q), crossed) << "segment " << i;
        blocked += crossed ? 1 : 0;
    }
    // Both results must occur often.
    EXPECT_GT(blocked, 100);
    EXPECT_LT(blocked, 900);
}

TEST(TriangleTree, SegmentIsMetFromEitherSide)
{
    const TriangleTree tree(testing::square());
    EXPECT_TRUE(tree.is_met({0.3, 0.6, 1.0}, {0.3, 0.6, -1.0}));
    EXPECT_TRUE(tree.is_met({0.3, 0.6, -1.0}, {0.3, 0.6, 1.0}));
    EXPECT_FALSE(tree.is_met({1.3, 0.6, 1.0}, {1.3, 0.6, -1.0}));
    EXPECT_FALSE(tree.is_met({0.3, 0.6, 1.0}, {0.3, 0.6, 1e-9}));
}

TEST(TriangleTree, FirstHitMatchesBruteForce)
{
    const TriMesh mesh = testing::random_soup(40, 21);
    const TriangleTree tree(mesh);
    int fronts = 0;
    int backs = 0;
    int beyond = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const Eigen::Vector3d p = random_point(22, 2 * i);
        const Eigen::Vector3d q = random_point(22, 2 * i + 1);
        const std::optional<FirstHit> nearest = testing::first_hit_of_all(mesh, p, q);
        const std::optional<FirstHit> found = tree.first_hit(p, q);
        ASSERT_EQ(found.has_value(), nearest.has_value()) << "ray " << i;
        if (!found) continue;
        EXPECT_NEAR(found->along, nearest->along, 1e-12 * (1.0 + nearest->along)) << "ray " << i;
        EXPECT_EQ(found->front, nearest->front) << "ray " << i;
        (found->front ? fronts : backs) += 1;
        beyond += found->along > 1.0 ? 1 : 0;
    }
    // Every kind of result must occur often.
    EXPECT_GT(fronts, 300);
    EXPECT_GT(backs, 300);
    EXPECT_GT(beyond, 20);
    EXPECT_LT(fronts + backs, 1900);
}

TEST(TriangleTree, FirstHitDistinguishesFrontAndBack)
{
    const TriangleTree tree(together(testing::square(), testing::square(-1.0)));
    const auto above = tree.first_hit({0.3, 0.6, 2.0}, {0.3, 0.6, 1.5});
    ASSERT_TRUE(above.has_value());
    EXPECT_DOUBLE_EQ(above->along, 4.0);
    EXPECT_TRUE(above->front);
    const auto below = tree.first_hit({0.3, 0.6, -2.0}, {0.3, 0.6, 0.0});
    ASSERT_TRUE(below.has_value());
    EXPECT_DOUBLE_EQ(below->along, 0.5);
    EXPECT_FALSE(below->front);
    EXPECT_FALSE(tree.first_hit({1.3, 0.6, 2.0}, {1.3, 0.6, 1.0}).has_value());
    EXPECT_FALSE(tree.first_hit({0.3, 0.6, 2.0}, {0.3, 0.6, 3.0}).has_value());
}

TEST(TriangleTree, FirstHitIncludesBoundaryOfFaces)
{
    const TriangleTree tree(testing::square());
    // The diagonal, a corner and the outer edges.
    for (const double x : {0.0, 0.5, 1.0}) {
        for (const double y : {0.0, 0.5, 1.0}) {
            const auto hit = tree.first_hit({x, y, 3.0}, {x, y, 2.0});
            ASSERT_TRUE(hit.has_value()) << x << ' ' << y;
            EXPECT_EQ(hit->along, 3.0);
            EXPECT_TRUE(hit->front);
        }
    }
    EXPECT_FALSE(tree.first_hit({1.0 + 1e-15, 0.5, 3.0}, {1.0 + 1e-15, 0.5, 2.0}).has_value());
}

/// A bumpy surface of n x n quads over [0, 1] x [0, 1], with slopes of at most 1.
TriMesh hills(std::uint32_t n)
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double height = 0.5 * random_number(31, i * (n + 1) + j) / n;
            mesh.positions.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n,
                                        height);
        }
    }
    mesh.faces = testing::grid_faces(n + 1);
    return mesh;
}

TEST(TriangleTree, FirstHitMissesNoEdgeOrVertex)
{
    const TriMesh mesh = hills(20);
    const TriangleTree tree(mesh);
    const Eigen::Vector3d above(0.43, 0.61, 3.0);
    int rays = 0;
    for (const Face& face : mesh.faces) {
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d& a = mesh.positions[face[i]];
            const Eigen::Vector3d& b = mesh.positions[face[(i + 1) % 3]];
            for (const double share : {0.0, 0.5, 0.3}) {
                const Eigen::Vector3d place = a + share * (b - a);
                if (place.head<2>().minCoeff() <= 0.0 || place.head<2>().maxCoeff() >= 1.0)
                    continue;
                const auto hit = tree.first_hit(above, place);
                ASSERT_TRUE(hit.has_value());
                EXPECT_TRUE(hit->front);
                EXPECT_NEAR(hit->along, 1.0, 1e-12);
                ++rays;
            }
        }
    }
    EXPECT_GT(rays, 6000);
}

TEST(TriangleTree, FirstHitIgnoresFacesParallelToRay)
{
    const TriangleTree tree(testing::square());
    EXPECT_FALSE(tree.first_hit({-1.0, 0.3, 0.0}, {0.0, 0.3, 0.0}).has_value());
    // The ray in the plane of a cube's side hits only the face at its end.
    const TriangleTree box(testing::cube());
    const auto hit = box.first_hit({-1.0, 0.3, 0.0}, {-0.5, 0.3, 0.0});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->along, 2.0);
    EXPECT_TRUE(hit->front);
}

TEST(TriangleTree, AcceptsASingleFace)
{
    TriMesh mesh = testing::square();
    mesh.faces.resize(1);
    const TriangleTree tree(mesh);
    EXPECT_DOUBLE_EQ(tree.distance({0.75, 0.25, 3.0}), 3.0);
    EXPECT_TRUE(tree.is_met({0.75, 0.25, 3.0}, {0.75, 0.25, -3.0}));
    EXPECT_FALSE(tree.is_met({0.25, 0.75, 3.0}, {0.25, 0.75, -3.0}));
    EXPECT_TRUE(tree.first_hit({0.75, 0.25, 3.0}, {0.75, 0.25, 2.0}).has_value());
    EXPECT_FALSE(tree.first_hit({0.25, 0.75, 3.0}, {0.25, 0.75, 2.0}).has_value());
}

TEST(TriangleTree, IgnoresDegenerateFacesOfMeshes)
{
    TriMesh mesh = testing::square();
    mesh.positions.emplace_back(0.5, 0.5, std::numeric_limits<double>::quiet_NaN());
    mesh.positions.emplace_back(0.5, 0.5, 2.0);
    mesh.faces.push_back({0, 1, 4});
    mesh.faces.push_back({5, 5, 5});
    const TriangleTree tree(mesh);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, 0.5, 3.0}), 3.0);
}

using Triangle = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d random_place(std::mt19937_64& engine)
{
    // Positions on a grid make segments meet edges and corners, too.
    std::uniform_int_distribution<int> coordinate(0, 6);
    const int x = coordinate(engine);
    const int y = coordinate(engine);
    return {static_cast<double>(x), static_cast<double>(y),
            static_cast<double>(coordinate(engine))};
}

TEST(TriangleTree, SegmentIsMetIfItMeetsAnyTriangle)
{
    std::mt19937_64 engine(7);
    std::vector<Triangle> triangles;
    while (triangles.size() < 12) {
        const Triangle t = {random_place(engine), random_place(engine), random_place(engine)};
        if (!collinear(t[0], t[1], t[2])) triangles.push_back(t);
    }
    const TriangleTree tree(triangles);
    int met = 0;
    int asked = 0;
    while (asked < 2000) {
        const Eigen::Vector3d from = random_place(engine);
        const Eigen::Vector3d to = random_place(engine);
        if (from == to) continue;
        ++asked;
        const bool expected = std::ranges::any_of(
            triangles, [&](const Triangle& t) { return meets_triangle(from, to, t); });
        EXPECT_EQ(tree.is_met(from, to), expected);
        met += expected ? 1 : 0;
    }
    EXPECT_GT(met, 500);
    EXPECT_LT(met, 1900);
}

TEST(TriangleTree, VisitsEachMetTriangleOnce)
{
    std::mt19937_64 engine(8);
    std::vector<Triangle> triangles(40);
    for (Triangle& triangle : triangles) { // some are degenerate
        triangle = {random_place(engine), random_place(engine), random_place(engine)};
    }
    const TriangleTree tree(triangles);
    std::size_t met = 0;
    for (int asked = 0; asked < 500; ++asked) {
        const Eigen::Vector3d from = random_place(engine);
        const Eigen::Vector3d to = random_place(engine);
        if (from == to) continue;
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto& [a, b, c] = triangles[i];
            if (!collinear(a, b, c) && meets_triangle(from, to, triangles[i]))
                expected.push_back(i);
        }
        std::vector<std::size_t> shown;
        tree.visit_met(from, to, [&](std::size_t i) { shown.push_back(i); });
        std::ranges::sort(shown);
        EXPECT_EQ(shown, expected);
        met += shown.size();
    }
    EXPECT_GT(met, 500U);
    TriangleTree(std::span<const Triangle>()).visit_met({1, 0, 1}, {1, 0, -1}, [](std::size_t) {
        FAIL();
    });
}

TEST(TriangleTree, IgnoresDegenerateTriangles)
{
    const std::vector<Triangle> flat = {
        {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0, 0)}};
    EXPECT_FALSE(TriangleTree(flat).is_met({1, 0, 1}, {1, 0, -1}));
    EXPECT_FALSE(TriangleTree(std::span<const Triangle>()).is_met({1, 0, 1}, {1, 0, -1}));
    EXPECT_TRUE(TriangleTree(flat).is_empty());
}

} // namespace
} // namespace vcarve::triangle_tree_test
