#include "base/predicates.h"
#include "compare/sample.h"
#include "compare/surface_tree.h"
#include "support/measured_scenes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace vcarve {
namespace {

Eigen::Vector3d random_point(std::uint64_t seed, std::uint64_t index)
{
    const Eigen::Vector3d unit(random_number(seed, 3 * index), random_number(seed, 3 * index + 1),
                               random_number(seed, 3 * index + 2));
    return 2.0 * unit - Eigen::Vector3d::Constant(0.5);
}

double distance_to_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b)
{
    const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - t * (b - a)).norm();
}

double distance_to_face(const TriMesh& mesh, const Face& face, const Eigen::Vector3d& x)
{
    const Eigen::Vector3d& a = mesh.positions[face[0]];
    const Eigen::Vector3d& b = mesh.positions[face[1]];
    const Eigen::Vector3d& c = mesh.positions[face[2]];
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    const Eigen::Vector3d foot = x - n * n.dot(x - a);
    const bool inside = (b - a).cross(foot - a).dot(n) >= 0 &&
                        (c - b).cross(foot - b).dot(n) >= 0 && (a - c).cross(foot - c).dot(n) >= 0;
    if (inside) return (x - foot).norm();
    return std::min(
        {distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, a)});
}

/// Exact where nothing is degenerate: the ends lie on different sides and the line runs inside.
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

TEST(SurfaceTree, MeasuresDistancesByHand)
{
    const SurfaceTree tree(testing::square());
    EXPECT_DOUBLE_EQ(tree.distance({0.3, 0.6, 2.0}), 2.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.3, 0.6, -2.0}), 2.0);
    EXPECT_DOUBLE_EQ(tree.distance({4.0, 5.0, 0.0}), 5.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, -1.0, 0.0}), 1.0);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, 0.25, 0.0}), 0.0);
}

TEST(SurfaceTree, DistancesEqualTheNearestOfAllFaces)
{
    const TriMesh mesh = testing::random_soup(60, 11);
    const SurfaceTree tree(mesh);
    for (std::uint64_t i = 0; i < 500; ++i) {
        const Eigen::Vector3d x = random_point(12, i);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Face& face : mesh.faces) {
            nearest = std::min(nearest, distance_to_face(mesh, face, x));
        }
        EXPECT_NEAR(tree.distance(x), nearest, 1e-12);
    }
}

TEST(SurfaceTree, BlocksWhereAnyFaceIsCrossed)
{
    const TriMesh mesh = testing::random_soup(12, 13);
    const SurfaceTree tree(mesh);
    int blocked = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const Eigen::Vector3d p = random_point(14, 2 * i);
        const Eigen::Vector3d q = random_point(14, 2 * i + 1);
        const bool crossed = std::ranges::any_of(
            mesh.faces, [&](const Face& face) { return crosses_face(mesh, face, p, q); });
        EXPECT_EQ(tree.blocks(p, q), crossed) << "segment " << i;
        blocked += crossed ? 1 : 0;
    }
    // Both answers occurred, so the comparison meant something.
    EXPECT_GT(blocked, 100);
    EXPECT_LT(blocked, 900);
}

TEST(SurfaceTree, BlocksFromEitherSideButNotBesideOrBefore)
{
    const SurfaceTree tree(testing::square());
    EXPECT_TRUE(tree.blocks({0.3, 0.6, 1.0}, {0.3, 0.6, -1.0}));
    EXPECT_TRUE(tree.blocks({0.3, 0.6, -1.0}, {0.3, 0.6, 1.0}));
    EXPECT_FALSE(tree.blocks({1.3, 0.6, 1.0}, {1.3, 0.6, -1.0}));
    EXPECT_FALSE(tree.blocks({0.3, 0.6, 1.0}, {0.3, 0.6, 1e-9}));
}

TEST(SurfaceTree, WorksOnASingleFace)
{
    TriMesh mesh = testing::square();
    mesh.faces.resize(1);
    const SurfaceTree tree(mesh);
    EXPECT_DOUBLE_EQ(tree.distance({0.75, 0.25, 3.0}), 3.0);
    EXPECT_TRUE(tree.blocks({0.75, 0.25, 3.0}, {0.75, 0.25, -3.0}));
    EXPECT_FALSE(tree.blocks({0.25, 0.75, 3.0}, {0.25, 0.75, -3.0}));
}

TEST(SurfaceTree, LeavesOutFacesWithoutArea)
{
    TriMesh mesh = testing::square();
    mesh.positions.emplace_back(0.5, 0.5, std::numeric_limits<double>::quiet_NaN());
    mesh.positions.emplace_back(0.5, 0.5, 2.0);
    mesh.faces.push_back({0, 1, 4});
    mesh.faces.push_back({5, 5, 5});
    const SurfaceTree tree(mesh);
    EXPECT_DOUBLE_EQ(tree.distance({0.5, 0.5, 3.0}), 3.0);
}

} // namespace
} // namespace vcarve
