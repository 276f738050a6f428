#include "mesh/half_edge_mesh.h"
#include "steps/7_refine/refine.h"
#include "support/grid_faces.h"
#include "support/half_edges.h"
#include "support/made_cells.h"
#include "support/noisy_ground.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>

namespace vcarve::denoise_vertices_test {
namespace {

using Eigen::Vector3d;
using testing::flat;
using testing::ground;
using testing::half_edges;
using testing::kUpOfAPixel;
using testing::rms;

constexpr double kSpacing = 0.02; ///< point spacing of the ground

/// The mean reprojection error of a point of two views with a noise of `noise_px`. Three of the
/// four coordinates determine the point.
double mean_error_px(double noise_px)
{
    return noise_px * std::sqrt(std::numbers::pi / 2.0) * std::sqrt(1.0 / 4.0);
}

/// Ground with points that were matched in images.
Scene matched_ground(double noise_px, const std::function<double(double, double)>& rise = flat)
{
    Scene scene = ground(noise_px, rise);
    scene.errors_px.assign(scene.num_points(), mean_error_px(noise_px));
    return scene;
}

std::uint32_t side_of(const Scene& ground)
{
    return static_cast<std::uint32_t>(
        std::lround(std::sqrt(static_cast<double>(ground.num_points()))));
}

bool is_on_rim(const Scene& ground, std::uint32_t vertex)
{
    const std::uint32_t side = side_of(ground);
    const std::uint32_t x = vertex / side;
    const std::uint32_t y = vertex % side;
    return x == 0 || y == 0 || x == side - 1 || y == side - 1;
}

/// The surface of the ground: two faces per square of its grid, facing up.
TriMesh surface_of(const Scene& ground)
{
    TriMesh mesh;
    mesh.positions = ground.positions;
    mesh.points.resize(mesh.positions.size());
    std::iota(mesh.points.begin(), mesh.points.end(), 0U);
    mesh.faces = testing::grid_faces(side_of(ground));
    return mesh;
}

struct Settled {
    TriMesh mesh;
    DenoiseVerticesCounts counts;
};

Settled settled(const TriMesh& mesh, const Scene& scene, double sigmas = 2.0)
{
    HalfEdgeMesh surface = half_edges(mesh);
    const DenoiseVerticesCounts counts = denoise_vertices(surface, scene, {.denoise = sigmas});
    return {tri_mesh(surface), counts};
}

Settled settled(const Scene& ground, double sigmas = 2.0)
{
    return settled(surface_of(ground), ground, sigmas);
}

Vector3d normal_of(const TriMesh& mesh, const Face& face)
{
    const Vector3d& a = mesh.positions[face[0]];
    return (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a).normalized();
}

TEST(SettleVertices, FlattensAPlaneAndEstimatesItsNoise)
{
    const Scene scene = matched_ground(0.05);
    const Settled result = settled(scene);
    EXPECT_LT(rms(result.mesh.positions), 0.6 * rms(scene.positions));
    EXPECT_NEAR(result.counts.noise_px, 0.05, 1e-9);
    EXPECT_EQ(result.counts.vertices, static_cast<std::int64_t>(scene.num_points()));
    std::int64_t moved = 0;
    for (std::uint32_t v = 0; v < scene.num_points(); ++v) {
        const bool is_moved = result.mesh.positions[v] != scene.positions[v];
        EXPECT_TRUE(!is_moved || !is_on_rim(scene, v)) << v;
        moved += is_moved ? 1 : 0;
    }
    EXPECT_EQ(result.counts.moved, moved);
    EXPECT_EQ(moved, std::pow(side_of(scene) - 2, 2)) << "all except the boundary";
    EXPECT_EQ(result.mesh.faces, surface_of(scene).faces);
}

TEST(SettleVertices, EstimatesNoiseForAnyNumberOfViews)
{
    // With four views, three of eight coordinates determine the point.
    Scene scene = matched_ground(0.05);
    scene.views.push_back(scene.views[0]);
    scene.views.push_back(scene.views[1]);
    scene.tracks = {};
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        scene.tracks.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    }
    const double mean_px = 0.05 * std::sqrt(std::numbers::pi / 2.0) * std::sqrt(5.0 / 8.0);
    scene.errors_px.assign(scene.num_points(), mean_px);
    EXPECT_NEAR(settled(scene).counts.noise_px, 0.05, 1e-9);
}

TEST(SettleVertices, LimitsNoiseToThatOfTheHeights)
{
    // Bad cameras increase reprojection errors, but not the roughness of the surface.
    Scene scene = matched_ground(0.05);
    scene.errors_px.assign(scene.num_points(), 5.0);
    EXPECT_NEAR(settled(scene).counts.noise_px, 0.05, 0.015);
    Scene exact = matched_ground(0.0);
    exact.errors_px.assign(exact.num_points(), 5.0);
    const Settled result = settled(exact);
    EXPECT_EQ(result.counts.moved, 0);
    EXPECT_EQ(result.mesh.positions, exact.positions);
}

TEST(SettleVertices, KeepsPointsWithZeroErrors)
{
    Scene scene = matched_ground(0.05);
    scene.errors_px.assign(scene.num_points(), 0.0);
    const Settled result = settled(scene);
    EXPECT_EQ(result.counts.noise_px, 0.0);
    EXPECT_EQ(result.mesh.positions, scene.positions);
}

TEST(SettleVertices, EstimatesNoiseFromHeightsIfNoErrorIsKnown)
{
    Scene scene = matched_ground(0.05);
    const Settled with_errors = settled(scene);
    scene.errors_px.assign(scene.num_points(), -1.0);
    const Settled result = settled(scene);
    EXPECT_NEAR(result.counts.noise_px, 0.05, 0.015);
    EXPECT_GT(result.counts.moved, with_errors.counts.moved * 9 / 10);
}

TEST(SettleVertices, KeepsExactPointsIfNoErrorIsKnown)
{
    Scene scene = matched_ground(0.0);
    for (std::size_t i = 0; i < scene.num_points(); i += 31) {
        scene.positions[i].z() += 0.5 * kSpacing; // shape, not noise
    }
    scene.errors_px.assign(scene.num_points(), -1.0);
    const Settled result = settled(scene);
    EXPECT_EQ(result.counts.noise_px, 0.0);
    EXPECT_EQ(result.mesh.positions, scene.positions);
}

TEST(SettleVertices, KeepsVerticesWithoutKnownErrors)
{
    Scene scene = matched_ground(0.05);
    TriMesh mesh = surface_of(scene);
    const std::uint32_t unknown = 1234;
    const std::uint32_t added = 1310;
    const std::uint32_t no_point = 1410;
    scene.errors_px[unknown] = -1.0;
    scene.kinds.assign(scene.num_points(), PointKind::measured);
    scene.kinds[added] = PointKind::border;
    mesh.points[no_point] = kNoPoint;
    const Settled result = settled(mesh, scene);
    for (const std::uint32_t vertex : {unknown, added, no_point}) {
        EXPECT_EQ(result.mesh.positions[vertex], scene.positions[vertex]);
        EXPECT_NE(result.mesh.positions[vertex + 1], scene.positions[vertex + 1]);
    }
}

TEST(SettleVertices, KeepsEdges)
{
    // Averaging that ignores normals would cut off the ridge of a roof.
    const auto roof = [](double x, double) { return -std::abs(x); };
    const Scene scene = matched_ground(0.03, roof);
    const Settled result = settled(scene);
    const double before = rms(scene.positions, roof);
    EXPECT_LT(rms(result.mesh.positions, roof), 0.8 * before);
    double lowered = 0.0;
    double near_ridge = 0.0;
    for (const Vector3d& position : result.mesh.positions) {
        if (std::abs(position.x()) > kSpacing) continue;
        lowered += roof(position.x(), position.y()) - position.z();
        near_ridge += 1.0;
    }
    EXPECT_LT(lowered / near_ridge, 0.5 * before);
}

TEST(SettleVertices, LimitsMovesByNoiseAndSpacing)
{
    Scene scene = matched_ground(0.05);
    const std::uint32_t outlier = 1234;
    scene.positions[outlier].z() += 4.0 * 0.05 * kUpOfAPixel;
    const Settled result = settled(scene);
    const double way = scene.positions[outlier].z() - result.mesh.positions[outlier].z();
    EXPECT_GT(way, 0.0);
    EXPECT_LT(way, 1.1 * 2.0 * 0.05 * kUpOfAPixel);

    const Scene noisy = matched_ground(0.5);
    const std::vector<double> spacings = vertex_spacings(half_edges(surface_of(noisy)));
    const Settled far = settled(noisy, 4.0);
    double farthest = 0.0;
    for (std::uint32_t v = 0; v < noisy.num_points(); ++v) {
        const double share = (far.mesh.positions[v] - noisy.positions[v]).norm() / spacings[v];
        farthest = std::max(farthest, share);
    }
    EXPECT_LE(farthest, 0.25 + 1e-9);
    EXPECT_GT(farthest, 0.2);
}

TEST(SettleVertices, FlipsNoFace)
{
    // The outer corners of thin faces must not move past each other.
    Scene scene = matched_ground(0.2);
    const std::uint32_t side = side_of(scene);
    for (std::uint32_t v = side; v < scene.num_points(); v += 2 * side) {
        for (std::uint32_t y = 0; y < side; ++y) {
            scene.positions[v + y].x() = scene.positions[v + y - side].x() + 0.0005;
        }
    }
    const TriMesh before = surface_of(scene);
    const Settled result = settled(scene);
    EXPECT_GT(result.counts.held, 100);
    EXPECT_GT(result.counts.moved, 1000);
    for (const Face& face : before.faces) {
        EXPECT_GT(normal_of(before, face).dot(normal_of(result.mesh, face)), 0.5 - 1e-9);
    }
}

TEST(SettleVertices, MovesVerticesInTheDirectionOfUncertainty)
{
    // The views are far above the ground, so points are uncertain vertically. Even on a steep slope
    // they move up and down, not across.
    const Scene scene = matched_ground(0.05, [](double x, double) { return 2.0 * x; });
    const Settled result = settled(scene);
    double up = 0.0;
    double across = 0.0;
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const Vector3d way = result.mesh.positions[i] - scene.positions[i];
        up += std::abs(way.z());
        across += way.head<2>().norm();
    }
    EXPECT_GT(up, 4.0 * across);
    EXPECT_GT(up, 0.0);
}

TEST(SettleVertices, RecomputesNormals)
{
    const Scene scene = matched_ground(0.05);
    HalfEdgeMesh surface = half_edges(surface_of(scene));
    denoise_vertices(surface, scene, {});
    for (const auto vertex : surface.vertices()) {
        EXPECT_EQ(surface.normal(vertex), vertex_normal(surface, vertex));
    }
}

TEST(SettleVertices, IsTheSameForAnyThreadCountAndScale)
{
    const auto wavy = [](double x, double y) { return 0.2 * std::sin(9.0 * x) * y; };
    const Scene scene = matched_ground(0.1, wavy);
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return settled(scene).mesh.positions; });
    };
    const std::vector<Vector3d> one = by(1);
    EXPECT_NE(one, scene.positions);
    EXPECT_EQ(one, by(2));
    EXPECT_EQ(one, by(3));
    const Scene larger = moved(scene, 1024.0, Eigen::Quaterniond::Identity(), Vector3d::Zero());
    const Settled result = settled(larger);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_LT((result.mesh.positions[i] - 1024.0 * one[i]).norm(), 1e-9 * 1024.0);
    }
}

TEST(SettleVertices, KeepsMeshesOfOneFaceOrNone)
{
    const Scene scene = matched_ground(0.05);
    TriMesh mesh = surface_of(scene);
    mesh.faces.resize(1);
    EXPECT_EQ(settled(mesh, scene).counts.moved, 0) << "all vertices are on the boundary";
    mesh.faces.clear();
    EXPECT_EQ(settled(mesh, scene).counts.vertices, 0);
}

} // namespace
} // namespace vcarve::denoise_vertices_test
