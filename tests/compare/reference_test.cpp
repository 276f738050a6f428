#include "compare/reference.h"
#include "support/measured_scenes.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace vcarve::reference_test {
namespace {

using testing::few_samples;
using testing::high_centers;
using testing::scene_above_square;
using testing::square;
using ::testing::ThrowsMessage;

Reference plain_reference()
{
    return make_reference(scene_above_square(21, high_centers()), nullptr, few_samples());
}

TEST(Reference, KeepsFinitePointsWithTwoViews)
{
    Scene scene = scene_above_square(3, high_centers());
    scene.positions.emplace_back(0.0, std::numeric_limits<double>::infinity(), 0.0);
    scene.tracks.push_back(std::vector<std::uint32_t>{0, 1});
    scene.positions.emplace_back(0.5, 0.5, 0.25);
    scene.tracks.push_back(std::vector<std::uint32_t>{2});
    scene.positions.emplace_back(0.5, 0.5, 0.75);
    scene.tracks.push_back(std::vector<std::uint32_t>{1, 3});
    const Reference reference = make_reference(scene, nullptr, few_samples());
    ASSERT_EQ(reference.scene.num_points(), 10U);
    EXPECT_EQ(reference.scene.positions[9] + reference.origin, Eigen::Vector3d(0.5, 0.5, 0.75));
    EXPECT_THAT(reference.scene.tracks[9], ::testing::ElementsAre(1, 3));
    EXPECT_EQ(reference.spacings.size(), 10U);
}

TEST(Reference, CentersAllDataOnTheMedianPoint)
{
    Scene scene = scene_above_square(21, high_centers());
    scene.offset = {1000.0, 0.0, 0.0};
    const Reference reference = make_reference(scene, nullptr, few_samples());
    EXPECT_TRUE(reference.origin.isApprox(Eigen::Vector3d(1000.5, 0.5, 0.0)));
    EXPECT_TRUE(reference.scene.views[0].center.isApprox(Eigen::Vector3d(-0.3, -0.3, 10.0)));
    TriMesh mesh = square();
    mesh.offset = {1000.0, 0.0, 0.0};
    const MeasuredMesh placed = place_mesh({"a.ply", mesh}, reference);
    EXPECT_TRUE(placed.mesh.positions[0].isApprox(Eigen::Vector3d(-0.5, -0.5, 0.0)));
}

TEST(Reference, RejectsAModelWithFewerThanTwoPoints)
{
    Scene scene = scene_above_square(2, high_centers());
    scene.tracks = {};
    for (int i = 0; i < 4; ++i) {
        scene.tracks.push_back(std::vector<std::uint32_t>{0});
    }
    EXPECT_THAT([&] { make_reference(scene, nullptr, few_samples()); },
                ThrowsMessage<InputError>("the model has 0 points with two or more views, but a "
                                          "comparison needs at least two such points"));
}

TEST(PlaceMesh, RejectsAMeshWithoutFaces)
{
    TriMesh mesh = square();
    mesh.faces.clear();
    EXPECT_THAT(
        [&] {
            place_mesh({"cloud.ply", mesh}, plain_reference());
        },
        ThrowsMessage<InputError>("cloud.ply: the file has 4 vertices but no faces, so there "
                                  "is no surface to measure"));
}

TEST(PlaceMesh, RejectsAMeshWithoutArea)
{
    TriMesh mesh = square();
    mesh.faces = {{0, 1, 1}, {2, 2, 2}};
    EXPECT_THAT(
        [&] {
            place_mesh({"flat.ply", mesh}, plain_reference());
        },
        ThrowsMessage<InputError>("flat.ply: none of the 2 faces has an area, so there is no "
                                  "surface to measure"));
}

TEST(PlaceMesh, RejectsADistantMesh)
{
    const TriMesh elsewhere = testing::moved(square(), {100.0, 0.0, 0.0});
    EXPECT_THAT(
        [&] {
            place_mesh({"utm.ply", elsewhere}, plain_reference());
        },
        ThrowsMessage<InputError>(
            "utm.ply: the mesh is in another frame than the model: its box is (100, 0, 0) to "
            "(101, 1, 0), but most points of the model are in (0.05, 0.05, 0) to (0.95, 0.95, "
            "0)"));
}

TEST(PlaceMesh, RejectsAMeshInAnotherUnit)
{
    // Millimeters instead of meters, and vice versa; both overlap the model.
    const auto place = [](double factor) {
        place_mesh({"mm.ply", testing::scaled(square(), factor)}, plain_reference());
    };
    EXPECT_THAT(
        [&] { place(1000.0); },
        ThrowsMessage<InputError>(
            "mm.ply: the mesh is in another frame than the model: its box is (0, 0, 0) to "
            "(1000, 1000, 0), but most points of the model are in (0.05, 0.05, 0) to (0.95, "
            "0.95, 0)"));
    EXPECT_THROW(place(0.001), InputError);
    EXPECT_NO_THROW(place(40.0));
    EXPECT_NO_THROW(place(0.5));
}

TEST(PlaceMesh, AcceptsAFewStrayPointsAndFaces)
{
    Scene scene = scene_above_square(21, high_centers());
    scene.positions[0] = {1e6, 1e6, 1e6};
    const Reference reference = make_reference(scene, nullptr, few_samples());
    TriMesh mesh = testing::torus(10);
    mesh.positions.emplace_back(-1e6, 0.0, 0.0);
    mesh.faces.push_back({0, 1, 100});
    EXPECT_NO_THROW(place_mesh({"a.ply", mesh}, reference));
}

using ::testing::DoubleEq;
using ::testing::Each;
using ::testing::ElementsAre;

TEST(PointSpacings, AreDistancesToTheSixthNearest)
{
    std::vector<Eigen::Vector3d> line;
    for (int i = 0; i < 10; ++i) {
        line.emplace_back(i, 0, 0);
    }
    EXPECT_THAT(point_spacings(line), ElementsAre(6, 5, 4, 3, 3, 3, 3, 4, 5, 6));
}

TEST(PointSpacings, UseTheFarthestOfFewPoints)
{
    const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {3, 4, 0}};
    EXPECT_THAT(point_spacings(points), ElementsAre(5, 5));
}

TEST(PointSpacings, AreAtLeastAHundredthOfTheMedian)
{
    std::vector<Eigen::Vector3d> points(50, Eigen::Vector3d(-9, 0, 0));
    for (int i = 0; i < 60; ++i) {
        points.emplace_back(i, 0, 0);
    }
    const std::vector<double> spacings = point_spacings(points);
    EXPECT_THAT(std::vector<double>(spacings.begin(), spacings.begin() + 50), Each(DoubleEq(0.03)));
}

TEST(PointSpacings, AreZeroIfAllPointsCoincide)
{
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    EXPECT_THAT(point_spacings(points), Each(0.0));
}

using testing::strip;

TEST(SampleSurface, SamplesFacesInProportionToTheirArea)
{
    // Two faces have an area of 1.5 and two of 0.5: 3/8 and 1/8 of the samples each.
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

TEST(SampleSurface, PlacesSamplesOnTheirFaces)
{
    const TriMesh mesh = testing::random_soup(50, 3);
    const SurfaceSamples samples = sample_surface(mesh, 2000, 1);
    for (std::size_t i = 0; i < samples.positions.size(); ++i) {
        const Face& face = mesh.faces[samples.faces[i]];
        const Eigen::Vector3d& a = mesh.positions[face[0]];
        const Eigen::Vector3d& b = mesh.positions[face[1]];
        const Eigen::Vector3d& c = mesh.positions[face[2]];
        const Eigen::Vector3d& x = samples.positions[i];
        // The three triangles of a sample and the sides fill the face.
        const double parts =
            (a - x).cross(b - x).norm() + (b - x).cross(c - x).norm() + (c - x).cross(a - x).norm();
        EXPECT_NEAR(parts, (b - a).cross(c - a).norm(), 1e-12);
    }
}

TEST(SampleSurface, IsUniformOnAFace)
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

TEST(SampleSurface, IsEmptyIfNoFaceHasAnArea)
{
    TriMesh mesh = testing::square();
    mesh.faces = {{0, 1, 1}};
    EXPECT_TRUE(sample_surface(mesh, 100, 1).positions.empty());
    EXPECT_TRUE(sample_surface({}, 100, 1).positions.empty());
}

} // namespace
} // namespace vcarve::reference_test
