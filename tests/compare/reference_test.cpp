#include "compare/reference.h"
#include "support/measured_scenes.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>

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

TEST(Reference, KeepsFinitePointsThatTwoViewsSaw)
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

TEST(Reference, PutsEverythingAroundTheMedianPoint)
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

TEST(Reference, RefusesAModelWithFewerThanTwoPoints)
{
    Scene scene = scene_above_square(2, high_centers());
    scene.tracks = {};
    for (int i = 0; i < 4; ++i) {
        scene.tracks.push_back(std::vector<std::uint32_t>{0});
    }
    EXPECT_THAT([&] { make_reference(scene, nullptr, few_samples()); },
                ThrowsMessage<InputError>("the model has 0 points that at least two views saw, but "
                                          "meshes can be measured only against two or more"));
}

TEST(PlaceMesh, RefusesAMeshWithoutFaces)
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

TEST(PlaceMesh, RefusesAMeshWithoutArea)
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

TEST(PlaceMesh, RefusesAMeshThatLiesElsewhere)
{
    const TriMesh elsewhere = testing::moved(square(), {100.0, 0.0, 0.0});
    EXPECT_THAT(
        [&] {
            place_mesh({"utm.ply", elsewhere}, plain_reference());
        },
        ThrowsMessage<InputError>(
            "utm.ply: the mesh lies in another frame than the model: it spans (100, 0, 0) to "
            "(101, 1, 0), but most points of the model lie in (0.05, 0.05, 0) to (0.95, 0.95, "
            "0)"));
}

TEST(PlaceMesh, RefusesAMeshOfAnotherUnit)
{
    // Millimetres for metres and the reverse; both still overlap the model.
    const auto place = [](double factor) {
        place_mesh({"mm.ply", testing::scaled(square(), factor)}, plain_reference());
    };
    EXPECT_THAT(
        [&] { place(1000.0); },
        ThrowsMessage<InputError>(
            "mm.ply: the mesh lies in another frame than the model: it spans (0, 0, 0) to "
            "(1000, 1000, 0), but most points of the model lie in (0.05, 0.05, 0) to (0.95, "
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

} // namespace
} // namespace vcarve::reference_test
