#include "mesh/vertices.h"

#include <gtest/gtest.h>

#include <vector>

namespace vcarve::vertices_test {
namespace {

using Eigen::Vector3d;

TEST(VertexFaces, ListFlaggedFacesInAscendingOrder)
{
    const std::vector<Face> faces = {{2, 0, 1}, {0, 2, 3}, {3, 2, 1}};
    const auto row = [](const VertexFaces& at, std::size_t vertex) {
        return std::vector<std::uint32_t>(at[vertex].begin(), at[vertex].end());
    };
    const VertexFaces all(faces, 5);
    EXPECT_EQ(row(all, 0), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(row(all, 2), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(row(all, 4).empty());
    const VertexFaces some(faces, 5, {1, 0, 1});
    EXPECT_EQ(row(some, 0), (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(row(some, 3), (std::vector<std::uint32_t>{2}));
}

TEST(UsedVertices, AreAscendingAndRenumberFaces)
{
    std::vector<Face> faces = {{4, 1, 2}, {2, 1, 7}};
    const std::vector<std::uint32_t> used = used_vertices(faces, 9);
    EXPECT_EQ(used, (std::vector<std::uint32_t>{1, 2, 4, 7}));
    renumber(faces, used, 9);
    EXPECT_EQ(faces, (std::vector<Face>{{2, 0, 1}, {1, 0, 3}}));
}

TEST(UsedVertices, AreEmptyWithoutFaces)
{
    EXPECT_TRUE(used_vertices({}, 5).empty());
}

/// A square of two faces, with the points 100 to 103.
TriMesh square()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {2, 3, 0}};
    mesh.colors = {{0, 0, 255}, {3, 10, 254}, {6, 20, 253}, {9, 30, 252}};
    mesh.points = {100, 101, 102, 103};
    return mesh;
}

TEST(AddMidpoint, AddsVertexWithMeanColorAndNoPoint)
{
    TriMesh mesh = square();
    mesh.colors[1] = {10, 0, 255};
    mesh.colors[2] = {21, 1, 255};
    EXPECT_EQ(add_midpoint(mesh, 1, 2), 4U);
    EXPECT_EQ(mesh.positions[4], Vector3d(1, 0.5, 0));
    EXPECT_EQ(mesh.colors[4], (Color{16, 1, 255})) << "rounded up";
    EXPECT_EQ(mesh.points[4], kNoPoint);
    EXPECT_EQ(mesh.points[1], 101U);
}

TEST(AddCopy, CopiesPositionColorAndPoint)
{
    TriMesh mesh = square();
    EXPECT_EQ(add_copy(mesh, 2), 4U);
    EXPECT_EQ(mesh.positions[4], mesh.positions[2]);
    EXPECT_EQ(mesh.colors[4], mesh.colors[2]);
    EXPECT_EQ(mesh.points[4], 102U);
}

TEST(AddVertex, AddsNoColorsOrPointsToMeshesWithoutThem)
{
    TriMesh mesh = square();
    mesh.colors.clear();
    mesh.points.clear();
    add_copy(mesh, 0);
    add_midpoint(mesh, 0, 1);
    EXPECT_EQ(mesh.positions.size(), 6U);
    EXPECT_TRUE(mesh.colors.empty());
    EXPECT_TRUE(mesh.points.empty());
}

} // namespace
} // namespace vcarve::vertices_test
