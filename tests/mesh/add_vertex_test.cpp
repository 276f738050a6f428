#include "mesh/add_vertex.h"

#include <gtest/gtest.h>

namespace vcarve::add_vertex_test {
namespace {

using Eigen::Vector3d;

/// A square of two faces, of points 100 to 103.
TriMesh square()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {2, 3, 0}};
    mesh.colors = {{0, 0, 255}, {3, 10, 254}, {6, 20, 253}, {9, 30, 252}};
    mesh.points = {100, 101, 102, 103};
    return mesh;
}

TEST(AddMidpoint, HasTheMeanColourAndNoPoint)
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

TEST(AddCopy, IsTheSamePointInTheSameColour)
{
    TriMesh mesh = square();
    EXPECT_EQ(add_copy(mesh, 2), 4U);
    EXPECT_EQ(mesh.positions[4], mesh.positions[2]);
    EXPECT_EQ(mesh.colors[4], mesh.colors[2]);
    EXPECT_EQ(mesh.points[4], 102U);
}

TEST(AddVertex, AddsNeitherColoursNorPointsWhereThereAreNone)
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
} // namespace vcarve::add_vertex_test
