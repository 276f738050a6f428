#include "mesh/first_faces.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace vcarve::first_faces_test {
namespace {

using Eigen::Vector3d;

Vector3d any_place(std::mt19937& random)
{
    const auto share = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    return {share(), share(), share()};
}

/// Random triangles around `offset`.
TriMesh any_triangles(int count, const Vector3d& offset)
{
    std::mt19937 random(3);
    TriMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vector3d middle = 4.0 * any_place(random);
        for (int k = 0; k < 3; ++k) {
            mesh.positions.emplace_back(middle + any_place(random) + offset);
        }
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// The first hit of a ray by brute force; `is_close` if it depends on rounding.
struct Tried {
    std::uint32_t any = FirstFace::kNone;
    std::uint32_t front = FirstFace::kNone;
    bool is_close = false;
};

Tried try_all(const TriMesh& mesh, const Vector3d& eye, const Vector3d& towards)
{
    Tried tried;
    double nearest = std::numeric_limits<double>::infinity();
    double nearest_front = nearest;
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        const Vector3d& p = mesh.positions[mesh.faces[face][0]];
        const Vector3d u = mesh.positions[mesh.faces[face][1]] - p;
        const Vector3d v = mesh.positions[mesh.faces[face][2]] - p;
        Eigen::Matrix3d system;
        system << -towards, u, v;
        const Vector3d found = system.fullPivLu().solve(eye - p);
        if (!(found[0] > 0.0)) continue;
        const double least = std::min({found[1], found[2], 1.0 - found[1] - found[2]});
        if (std::abs(least) < 1e-4) tried.is_close = true;
        if (least < 0.0) continue;
        if (found[0] < nearest) {
            nearest = found[0];
            tried.any = face;
        }
        if (u.cross(v).dot(towards) < 0.0 && found[0] < nearest_front) {
            nearest_front = found[0];
            tried.front = face;
        }
    }
    return tried;
}

/// Compares 3000 rays with brute force. Returns how many hit a back side before a front side.
int compare_rays(const Vector3d& offset)
{
    const TriMesh mesh = any_triangles(300, offset);
    const Vector3d eye = Vector3d(0.1, -0.2, 0.3) + offset;
    const FirstFaces faces(mesh, eye);
    std::mt19937 random(5);
    int backs = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vector3d towards = any_place(random).normalized();
        const Tried tried = try_all(mesh, eye, towards);
        if (tried.is_close) continue;
        EXPECT_EQ(faces.along(towards).face, tried.any);
        EXPECT_EQ(faces.front_along(towards).face, tried.front);
        backs += tried.any == tried.front || tried.front == FirstFace::kNone ? 0 : 1;
    }
    return backs;
}

TEST(FirstFaces, MatchBruteForce)
{
    EXPECT_GT(compare_rays(Vector3d::Zero()), 100);
}

TEST(FirstFaces, MatchBruteForceFarFromTheOrigin)
{
    EXPECT_GT(compare_rays({3e6, -5e6, 1e6}), 100);
}

TEST(FirstFaces, ReturnBarycentricCoordinates)
{
    TriMesh mesh;
    mesh.positions = {{-1, -1, 4}, {3, -1, 4}, {-1, 3, 4}};
    mesh.faces = {{0, 1, 2}};
    const FirstFaces faces(mesh, Vector3d::Zero());
    const FirstFace straight = faces.along(Vector3d::UnitZ());
    ASSERT_EQ(straight.face, 0U);
    EXPECT_NEAR(straight.second, 0.25, 1e-6);
    EXPECT_NEAR(straight.third, 0.25, 1e-6);
    const FirstFace right = faces.along(Vector3d(1, 0, 4).normalized());
    EXPECT_NEAR(right.second, 0.5, 1e-6);
    EXPECT_NEAR(right.third, 0.25, 1e-6);
}

TEST(FirstFaces, LeaveNoCracksBetweenNeighbors)
{
    // A fan of thin triangles around the axis. Rays hit its edges and its center.
    TriMesh mesh;
    mesh.positions = {{0, 0, 1}};
    constexpr std::uint32_t kCorners = 1000;
    for (std::uint32_t i = 0; i < kCorners; ++i) {
        const double turn = i * 2.0 * EIGEN_PI / kCorners;
        mesh.positions.emplace_back(std::cos(turn), std::sin(turn), 1.0 + 0.1 * (i % 3));
        mesh.faces.push_back({0, i + 1, (i + 1) % kCorners + 1});
    }
    const FirstFaces faces(mesh, Vector3d::Zero());
    EXPECT_NE(faces.along(Vector3d::UnitZ()).face, FirstFace::kNone);
    for (std::uint32_t i = 1; i <= kCorners; ++i) {
        for (const double share : {0.1, 0.5, 0.9}) {
            const Vector3d place =
                mesh.positions[0] + share * (mesh.positions[i] - mesh.positions[0]);
            EXPECT_NE(faces.along(place.normalized()).face, FirstFace::kNone) << i;
        }
    }
}

TEST(FirstFaces, IgnoreFacesWithoutArea)
{
    TriMesh mesh;
    EXPECT_EQ(FirstFaces(mesh, Vector3d::Zero()).along(Vector3d::UnitZ()).face, FirstFace::kNone);
    mesh.positions = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.faces = {{0, 1, 2}};
    EXPECT_EQ(FirstFaces(mesh, Vector3d::Zero()).along(Vector3d::UnitZ()).face, FirstFace::kNone);
}

TEST(FirstFaces, FindTheSameFacesFromAnotherPoint)
{
    const TriMesh mesh = any_triangles(300, {3, 4, 5});
    const FirstFaces faces(mesh, {3, 4, 5});
    const Vector3d place(3.4, 4.2, 9.0);
    const FirstFaces from_there(mesh, place);
    std::mt19937 random(8);
    int met = 0;
    int same = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vector3d towards = (Vector3d(3, 4, 5) + 4.0 * any_place(random) - place).normalized();
        const std::uint32_t expected = from_there.along(towards).face;
        met += expected != FirstFace::kNone ? 1 : 0;
        same += faces.from(place, towards).face == expected ? 1 : 0;
    }
    EXPECT_GT(met, 500);
    EXPECT_GE(same, 1998); // rays through edges may differ
}

} // namespace
} // namespace vcarve::first_faces_test
