#include "compare/sample.h"
#include "support/measured_scenes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>

namespace vcarve::sample_test {
namespace {

using testing::strip;

TEST(SampleSurface, GivesEachFaceItsShareOfTheArea)
{
    // Two faces of 1.5 and two of 0.5: three eighths and one eighth of the samples each.
    const TriMesh mesh = testing::together(strip(0.0, 3.0, 0.0), strip(4.0, 5.0, 0.0));
    const SurfaceSamples samples = sample_surface(mesh, 8000, 1);
    ASSERT_EQ(samples.positions.size(), 8000U);
    EXPECT_TRUE(std::ranges::is_sorted(samples.faces));
    for (const std::uint32_t face : {0U, 1U}) {
        EXPECT_NEAR(std::ranges::count(samples.faces, face), 3000, 1);
    }
    for (const std::uint32_t face : {2U, 3U}) {
        EXPECT_NEAR(std::ranges::count(samples.faces, face), 1000, 1);
    }
}

TEST(SampleSurface, PutsSamplesOnTheirFaces)
{
    const TriMesh mesh = testing::random_soup(50, 3);
    const SurfaceSamples samples = sample_surface(mesh, 2000, 1);
    for (std::size_t i = 0; i < samples.positions.size(); ++i) {
        const Face& face = mesh.faces[samples.faces[i]];
        const Eigen::Vector3d& a = mesh.positions[face[0]];
        const Eigen::Vector3d& b = mesh.positions[face[1]];
        const Eigen::Vector3d& c = mesh.positions[face[2]];
        const Eigen::Vector3d& x = samples.positions[i];
        // The three triangles a sample makes with the sides fill the face.
        const double parts =
            (a - x).cross(b - x).norm() + (b - x).cross(c - x).norm() + (c - x).cross(a - x).norm();
        EXPECT_NEAR(parts, (b - a).cross(c - a).norm(), 1e-12);
    }
}

TEST(SampleSurface, SpreadsSamplesEvenlyOverAFace)
{
    const SurfaceSamples samples = sample_surface(testing::square(), 40000, 1);
    std::array<int, 16> squares{};
    for (const Eigen::Vector3d& x : samples.positions) {
        ++squares[static_cast<std::size_t>(4.0 * x.x()) +
                  4 * static_cast<std::size_t>(4.0 * x.y())];
    }
    for (const int count : squares) {
        EXPECT_NEAR(count, 2500, 4 * 50);
    }
}

TEST(SampleSurface, IsTheSameForAnyNumberOfThreads)
{
    const TriMesh mesh = testing::random_soup(50, 3);
    const SurfaceSamples many = sample_surface(mesh, 20000, 1);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(sample_surface(mesh, 20000, 1).positions, many.positions);
}

TEST(SampleSurface, ChangesWithTheSeed)
{
    const TriMesh mesh = testing::square();
    EXPECT_NE(sample_surface(mesh, 10, 1).positions, sample_surface(mesh, 10, 2).positions);
}

TEST(SampleSurface, SkipsFacesWithoutArea)
{
    TriMesh mesh = testing::square();
    mesh.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
    mesh.faces = {{0, 1, 1}, {0, 1, 4}, {0, 1, 2}, {0, 1, 1}};
    const SurfaceSamples samples = sample_surface(mesh, 100, 1);
    EXPECT_THAT(samples.faces, ::testing::Each(2U));
}

TEST(SampleSurface, IsEmptyWhereNothingHasArea)
{
    TriMesh mesh = testing::square();
    mesh.faces = {{0, 1, 1}};
    EXPECT_TRUE(sample_surface(mesh, 100, 1).positions.empty());
    EXPECT_TRUE(sample_surface({}, 100, 1).positions.empty());
}

} // namespace
} // namespace vcarve::sample_test
