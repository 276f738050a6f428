#include "geometry/triangle.h"
#include "steps/5_labels/boundary.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace vcarve::boundary_test {
namespace {

using Eigen::Vector3d;

TEST(Boundary, HasAFaceForEachFacetSeenFromOutside)
{
    const Scene scene = bumpy_sphere(300, 71);
    const TetMesh mesh = triangulate(scene);
    const Labels labels = testing::labels_where(
        mesh, [&](Index cell) { return testing::middle(mesh, cell).norm() < 0.9; });
    const std::vector<CellFacet> facets = boundary_facets(mesh, labels);
    const std::vector<Face> faces = boundary_faces(mesh, facets);
    std::size_t expected = 0;
    for (const Cell& cell : mesh.cells) {
        const bool is_inside =
            labels[static_cast<std::size_t>(&cell - mesh.cells.data())] == Label::inside;
        for (const Index neighbor : cell.neighbors) {
            if (is_inside && labels[neighbor] == Label::outside) ++expected;
        }
    }
    ASSERT_EQ(facets.size(), expected);
    ASSERT_EQ(faces.size(), expected);
    for (std::size_t i = 0; i < expected; ++i) {
        const auto [cell, slot] = facets[i];
        EXPECT_EQ(labels[cell], Label::inside);
        EXPECT_EQ(labels[mesh.cells[cell].neighbors[slot]], Label::outside);
        const Vector3d& behind = mesh.positions[mesh.cells[cell].vertices[slot]];
        const auto& [a, b, c] = faces[i];
        EXPECT_LT(face_normal(mesh.positions, faces[i]).dot(behind - mesh.positions[a]), 0.0);
        EXPECT_EQ(testing::cell_of(mesh, {a, b, c, mesh.cells[cell].vertices[slot]}), cell);
        EXPECT_EQ(place_of(facets[i], facets), i);
    }
}

TEST(CloseHull, CallsInfiniteCellsOutsideAndNoOthers)
{
    const TetMesh mesh = triangulate(bumpy_sphere(60, 3));
    Labels labels(mesh.cells.size(), Label::inside);
    close_hull(mesh, labels);
    for (std::size_t cell = 0; cell < labels.size(); ++cell) {
        EXPECT_EQ(labels[cell] == Label::outside, mesh.cells[cell].is_infinite());
    }
}

} // namespace
} // namespace vcarve::boundary_test
