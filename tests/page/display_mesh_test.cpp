#include "mesh/check.h"
#include "page/display_mesh.h"
#include "support/measured_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vcarve::display_mesh_test {
namespace {

TriMesh colored_torus(std::uint32_t n)
{
    TriMesh mesh = testing::torus(n);
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        mesh.colors.push_back({static_cast<std::uint8_t>(vertex), 7, 9});
        mesh.points.push_back(vertex);
    }
    return mesh;
}

TEST(DisplayMesh, NeedsNeitherColorsNorPoints)
{
    const TriMesh shown = display_mesh(testing::torus(20), 300);
    EXPECT_GT(shown.faces.size(), 250U);
    EXPECT_LE(shown.faces.size(), 300U);
    EXPECT_TRUE(shown.colors.empty());
    EXPECT_TRUE(shown.points.empty());
}

TEST(DisplayMesh, KeepsASmallSurface)
{
    const TriMesh mesh = colored_torus(10);
    const TriMesh shown = display_mesh(mesh, static_cast<std::int64_t>(mesh.faces.size()));
    EXPECT_EQ(shown.faces, mesh.faces);
    EXPECT_EQ(shown.positions, mesh.positions);
}

TEST(DisplayMesh, KeepsTheShapeWithinTheLimit)
{
    const TriMesh mesh = colored_torus(40);
    const TriMesh shown = display_mesh(mesh, 800);
    EXPECT_LE(shown.faces.size(), 800U);
    EXPECT_GE(shown.faces.size(), 700U);
    const MeshCheck check = check_mesh(shown);
    EXPECT_TRUE(check.is_closed());
    EXPECT_NEAR(check.area, check_mesh(mesh).area, 0.05 * check_mesh(mesh).area);
}

TEST(DisplayMesh, KeepsVertexAttributes)
{
    const TriMesh mesh = colored_torus(40);
    const TriMesh shown = display_mesh(mesh, 500);
    ASSERT_EQ(shown.points.size(), shown.positions.size());
    ASSERT_EQ(shown.colors.size(), shown.positions.size());
    for (std::size_t vertex = 0; vertex < shown.positions.size(); ++vertex) {
        const std::uint32_t was = shown.points[vertex];
        EXPECT_LE((shown.positions[vertex] - mesh.positions[was]).norm(), 1e-12);
        EXPECT_EQ(shown.colors[vertex], mesh.colors[was]);
    }
}

/// Components of one face each, which cannot be collapsed.
TriMesh confetti(std::uint32_t count)
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = 0.1 * i;
        mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 0.05, 0, 0}, {x, 0.05, 0.01}});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

TEST(DisplayMesh, ChoosesComponentsThatCannotBeCollapsed)
{
    const TriMesh mesh = confetti(1000);
    const TriMesh shown = display_mesh(mesh, 100);
    ASSERT_EQ(shown.faces.size(), 100U);
    EXPECT_EQ(shown.positions.size(), 300U);
    for (std::size_t i = 0; i < 100; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(
                (shown.positions[shown.faces[i][k]] - mesh.positions[mesh.faces[10 * i][k]]).norm(),
                0.0, 1e-12);
        }
    }
}

TEST(DisplayMesh, AcceptsAnyTriangles)
{
    EXPECT_LE(display_mesh(testing::random_soup(3000, 5), 300).faces.size(), 300U);
}

TEST(DisplayMesh, IsByteIdenticalForAnyThreadCount)
{
    for (const TriMesh& mesh : {colored_torus(90), confetti(9000)}) {
        TriMesh one;
        tbb::task_arena(1).execute([&] { one = display_mesh(mesh, 500); });
        TriMesh several;
        tbb::task_arena(3).execute([&] { several = display_mesh(mesh, 500); });
        EXPECT_EQ(one.faces, several.faces);
        EXPECT_EQ(one.positions, several.positions);
        EXPECT_LT(one.faces.size(), mesh.faces.size());
    }
}

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TriMesh triangle()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    mesh.faces = {{0, 1, 2}};
    return mesh;
}

TEST(EdgeParts, LimitTheLengthOfParts)
{
    // The longest edges of the square's faces are the square root of 2 long.
    const TriMesh square = testing::square();
    EXPECT_THAT(edge_parts(square, 1.5, 1000), ElementsAre(1, 1));
    EXPECT_THAT(edge_parts(square, 1.0, 1000), ElementsAre(2, 2));
    EXPECT_THAT(edge_parts(square, 0.5, 1000), ElementsAre(4, 4));
    EXPECT_THAT(edge_parts(testing::together(square, testing::scaled(square, 0.25)), 0.5, 1000),
                ElementsAre(4, 4, 1, 1));
}

TEST(EdgeParts, AreReducedIfThereAreTooManyFaces)
{
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 32), ElementsAre(4, 4));
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 31), ElementsAre(2, 2));
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 1), ElementsAre(1, 1));
}

TEST(EdgeParts, AreAtMost64)
{
    EXPECT_THAT(edge_parts(testing::square(), 1e-3, 1'000'000), Each(64));
}

TEST(GridPlaces, AreBetweenTheCornersRowByRow)
{
    const std::vector<std::int32_t> two = {2};
    EXPECT_THAT(
        grid_places(triangle(), two),
        ElementsAre(Eigen::Vector3d(0, 4, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 4, 0)));
    const std::vector<std::int32_t> four = {4};
    EXPECT_THAT(
        grid_places(triangle(), four),
        ElementsAre(Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 4, 0), Eigen::Vector3d(0, 6, 0),
                    Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(1, 4, 0),
                    Eigen::Vector3d(1, 6, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 2, 0),
                    Eigen::Vector3d(2, 4, 0), Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(3, 2, 0)));
}

TEST(GridPlaces, AreEmptyForFacesThatAreNotSplit)
{
    const std::vector<std::int32_t> one = {1};
    EXPECT_THAT(grid_places(triangle(), one), IsEmpty());
}

} // namespace
} // namespace vcarve::display_mesh_test
