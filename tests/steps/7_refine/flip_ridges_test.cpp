#include "base/random_number.h"
#include "geometry/triangle.h"
#include "mesh/check.h"
#include "mesh/half_edge_mesh.h"
#include "steps/7_refine/flip_ridges.h"
#include "support/grid_faces.h"
#include "support/half_edges.h"
#include "support/made_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::half_edges;

/// A grid of places (x, y, rise(x, y)) with x and y from -half to half, two faces a square, seen
/// from above.
TriMesh height_field(int half, const std::function<double(int, int)>& rise)
{
    TriMesh mesh;
    for (int x = -half; x <= half; ++x) {
        for (int y = -half; y <= half; ++y) {
            mesh.positions.emplace_back(x, y, rise(x, y));
        }
    }
    mesh.faces = testing::grid_faces(static_cast<std::uint32_t>(2 * half + 1));
    return mesh;
}

double bump(int x, int y)
{
    return 1.2 * random_number(3, static_cast<std::uint64_t>(1000 * (x + 100) + y + 100));
}

struct Flipped {
    TriMesh mesh;
    std::int64_t count = 0;
};

Flipped flipped(const TriMesh& mesh)
{
    HalfEdgeMesh surface = half_edges(mesh);
    const std::int64_t count = flip_ridges(surface);
    return {tri_mesh(surface), count};
}

/// The faces, each from its least vertex on.
std::set<Face> faces_of(const TriMesh& mesh)
{
    std::set<Face> faces;
    for (Face face : mesh.faces) {
        std::rotate(face.begin(), std::ranges::min_element(face), face.end());
        faces.insert(face);
    }
    return faces;
}

/// The edges of one face only, from the lesser vertex on.
std::set<std::array<std::uint32_t, 2>> rim_of(const TriMesh& mesh)
{
    std::set<std::array<std::uint32_t, 2>> rim;
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<std::uint32_t, 2> edge = {std::min(face[i], face[(i + 1) % 3]),
                                                       std::max(face[i], face[(i + 1) % 3])};
            if (!rim.erase(edge)) rim.insert(edge);
        }
    }
    return rim;
}

/// The height of a surface seen from above, at (x, y).
double height_at(const TriMesh& mesh, double x, double y)
{
    double height = -std::numeric_limits<double>::infinity();
    for (const Face& face : mesh.faces) {
        const Vector3d& a = mesh.positions[face[0]];
        const Vector3d& b = mesh.positions[face[1]];
        const Vector3d& c = mesh.positions[face[2]];
        const auto turn = [&](const Vector3d& p, const Vector3d& q) {
            return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
        };
        if (turn(a, b) < 0.0 || turn(b, c) < 0.0 || turn(c, a) < 0.0) continue;
        const Vector3d normal = scaled_normal(a, b, c);
        const double z = a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
        height = std::max(height, z);
    }
    return height;
}

/// The valley of z = slope |x|, whose bottom is bridged in every second place.
TriMesh bridged_valley(double slope, bool is_bridged)
{
    constexpr int kHalf = 5;
    const auto valley = [&](int x, int) { return slope * std::abs(x); };
    HalfEdgeMesh surface = half_edges(height_field(kHalf, valley));
    const auto at = [](int x, int y) {
        return OpenMesh::VertexHandle((2 * kHalf + 1) * (x + kHalf) + y + kHalf);
    };
    for (int y = -kHalf + 1; is_bridged && y + 1 < kHalf; y += 2) {
        const auto bottom = surface.edge_handle(surface.find_halfedge(at(0, y), at(0, y + 1)));
        surface.flip(bottom);
    }
    return tri_mesh(surface);
}

double angle_of(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The sum of the angles between the normals of faces beside each other.
double bend_of(const TriMesh& mesh)
{
    std::map<std::array<std::uint32_t, 2>, Vector3d> open;
    double bend = 0.0;
    for (const Face& face : mesh.faces) {
        const Vector3d normal = scaled_normal(mesh.positions[face[0]], mesh.positions[face[1]],
                                              mesh.positions[face[2]]);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = face[i];
            const std::uint32_t to = face[(i + 1) % 3];
            const auto other = open.find({to, from});
            if (other != open.end()) bend += angle_of(normal, other->second);
            open[{from, to}] = normal;
        }
    }
    return bend;
}

TEST(FlipRidges, BendsTheWholeSurfaceLessWithEachFlip)
{
    const TriMesh before = height_field(40, bump);
    const Flipped result = flipped(before);
    EXPECT_GT(result.count, 30);
    EXPECT_LT(bend_of(result.mesh), bend_of(before) - 0.2 * static_cast<double>(result.count));
}

Vector3d normal_of(const TriMesh& mesh, const Face& face)
{
    return scaled_normal(mesh.positions, face);
}

/// The corner of a face that is none of these two.
std::uint32_t apex_of(const Face& face, std::uint32_t from, std::uint32_t to)
{
    return *std::ranges::find_if(
        face, [&](std::uint32_t corner) { return corner != from && corner != to; });
}

/// The surface with the edge flipped that faces `one` and `other` share; nothing where they share
/// none, or it is no ridge that may be flipped.
std::optional<TriMesh> with_flip(const TriMesh& mesh, std::size_t one, std::size_t other)
{
    const auto has = [](const Face& face, std::uint32_t corner) {
        return std::ranges::find(face, corner) != face.end();
    };
    const Face& left = mesh.faces[one];
    const Face& right = mesh.faces[other];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = left[i];
        const std::uint32_t to = left[(i + 1) % 3];
        if (!has(right, from) || !has(right, to)) continue;
        const std::uint32_t c = apex_of(left, from, to);
        const std::uint32_t d = apex_of(right, from, to);
        const bool is_ridge =
            normal_of(mesh, left).dot(mesh.positions[d] - mesh.positions[from]) < 0.0;
        const double most_turn = 80.0 * std::numbers::pi / 180.0;
        TriMesh after = mesh;
        after.faces[one] = {d, c, from};
        after.faces[other] = {c, d, to};
        const double turn = angle_of(normal_of(mesh, left), normal_of(mesh, right));
        const double turn_after =
            angle_of(normal_of(after, after.faces[one]), normal_of(after, after.faces[other]));
        if (!is_ridge || turn > most_turn || turn_after > most_turn) return std::nullopt;
        return after;
    }
    return std::nullopt;
}

TEST(FlipRidges, FlipsWhatGainsMostOfAllTheSurfaceOneByOne)
{
    const TriMesh before = height_field(6, bump);
    TriMesh best = before;
    std::int64_t count = 0;
    for (bool is_found = true; is_found; count += is_found ? 1 : 0) {
        const TriMesh mesh = best;
        double least = bend_of(mesh) - 0.2;
        is_found = false;
        for (std::size_t one = 0; one < mesh.faces.size(); ++one) {
            for (std::size_t other = one + 1; other < mesh.faces.size(); ++other) {
                const std::optional<TriMesh> after = with_flip(mesh, one, other);
                if (!after || bend_of(*after) >= least) continue;
                least = bend_of(*after);
                best = *after;
                is_found = true;
            }
        }
    }
    const Flipped result = flipped(before);
    EXPECT_EQ(faces_of(result.mesh), faces_of(best));
    EXPECT_EQ(result.count, count);
    EXPECT_GT(count, 10);
}

TEST(FlipRidges, TakesBridgesOutOfAValley)
{
    const TriMesh bridged = bridged_valley(0.25, true);
    const TriMesh valley = bridged_valley(0.25, false);
    ASSERT_NE(faces_of(bridged), faces_of(valley));
    const Flipped result = flipped(bridged);
    EXPECT_EQ(result.count, 4);
    EXPECT_EQ(faces_of(result.mesh), faces_of(valley));
    EXPECT_EQ(result.mesh.positions, valley.positions);
    EXPECT_EQ(flipped(valley).count, 0);
}

TEST(FlipRidges, LeavesWhatTurnsTooFar)
{
    EXPECT_EQ(flipped(bridged_valley(0.5, true)).count, 0);
}

TEST(FlipRidges, LeavesEdgesBesideAFaceSoThinThatRoundingDecidesOnItsNormal)
{
    // The face beside a bridge at the edge from (0, 0) to (1, 1); its corner (1, 0) comes next to
    // it.
    for (const double height : {1e-9, 0.1}) {
        TriMesh mesh = bridged_valley(0.25, true);
        const auto at = [&](int x, int y) {
            return static_cast<std::uint32_t>(11 * (x + 5) + y + 5);
        };
        mesh.positions[at(1, 0)] = (mesh.positions[at(0, 0)] + mesh.positions[at(1, 1)]) / 2.0 +
                                   height * Vector3d(1.0, -1.0, 0.25);
        const std::set<Face> before = faces_of(mesh);
        const std::set<Face> after = faces_of(flipped(mesh).mesh);
        TriMesh bridge_alone;
        bridge_alone.faces = {{at(-1, 0), at(0, 0), at(1, 1)}};
        const std::set<Face> bridge = faces_of(bridge_alone);
        ASSERT_TRUE(std::ranges::includes(before, bridge));
        EXPECT_EQ(std::ranges::includes(after, bridge), height < 0.01) << height;
    }
}

TEST(FlipRidges, IsNowhereHigherThanBefore)
{
    constexpr int kHalf = 10;
    const TriMesh before = height_field(kHalf, bump);
    const Flipped result = flipped(before);
    EXPECT_GT(result.count, 30);
    double lowered = 0.0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const double x = kHalf * (2.0 * random_number(7, 2 * i) - 1.0);
        const double y = kHalf * (2.0 * random_number(7, 2 * i + 1) - 1.0);
        const double sunk = height_at(before, x, y) - height_at(result.mesh, x, y);
        EXPECT_GT(sunk, -1e-9);
        lowered = std::max(lowered, sunk);
    }
    EXPECT_GT(lowered, 0.1);
}

TEST(FlipRidges, KeepsVerticesRimsAndAManifold)
{
    const TriMesh before = height_field(10, bump);
    const Flipped result = flipped(before);
    EXPECT_EQ(result.mesh.positions, before.positions);
    EXPECT_EQ(result.mesh.faces.size(), before.faces.size());
    EXPECT_EQ(rim_of(result.mesh), rim_of(before));
    const MeshCheck check = check_mesh(result.mesh);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.degenerate_faces, 0);
    EXPECT_EQ(check.euler_characteristic, check_mesh(before).euler_characteristic);
}

TEST(FlipRidges, LeavesNothingToGain)
{
    const Flipped once = flipped(height_field(40, bump));
    EXPECT_EQ(flipped(once.mesh).count, 0);
}

TEST(FlipRidges, LeavesAPlane)
{
    EXPECT_EQ(flipped(height_field(4, [](int x, int y) { return 0.1 * x - 0.2 * y; })).count, 0);
}

TEST(FlipRidges, GivesNormalsOfTheNewFaces)
{
    HalfEdgeMesh surface = half_edges(height_field(10, bump));
    flip_ridges(surface);
    for (const auto vertex : surface.vertices()) {
        EXPECT_EQ(surface.normal(vertex), vertex_normal(surface, vertex));
    }
}

TEST(FlipRidges, IsTheSameForAnyNumberOfThreadsAndAtAnyScale)
{
    const TriMesh mesh = height_field(10, bump);
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return flipped(mesh).mesh.faces; });
    };
    const std::vector<Face> one = by(1);
    EXPECT_EQ(one, by(2));
    EXPECT_EQ(one, by(3));
    TriMesh larger = mesh;
    for (Vector3d& position : larger.positions) {
        position *= 1024.0;
    }
    EXPECT_EQ(flipped(larger).mesh.faces, one);
}

TEST(FlipRidges, GivesTheSameForFacesInAnyOrder)
{
    const TriMesh mesh = height_field(10, bump);
    TriMesh reversed = mesh;
    std::ranges::reverse(reversed.faces);
    EXPECT_EQ(faces_of(flipped(reversed).mesh), faces_of(flipped(mesh).mesh));
}

} // namespace
} // namespace vcarve
