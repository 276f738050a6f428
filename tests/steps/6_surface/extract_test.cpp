#include "mesh/check.h"
#include "steps/3_cells/triangulate.h"
#include "steps/6_surface/extract.h"
#include "steps/6_surface/orient.h"
#include "support/half_edges.h"
#include "support/scenes.h"
#include "support/tetra_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace vcarve::extract_test {
namespace {

using Eigen::Vector3d;
using testing::volume;

TEST(ExtractSurface, OfOneCellIsItsFourFacetsSeenFromOutside)
{
    const Scene scene = make_scene(
        {{9, 9, 9}}, {{{0, 0, 0}, {0}}, {{1, 0, 0}, {0}}, {{0, 1, 0}, {0}}, {{0, 0, 1}, {0}}});
    const TetMesh cells = triangulate(scene);
    Labels labels(cells.cells.size(), Label::outside);
    labels[cells.cell_of_vertex[0]] = Label::inside;
    const TriMesh mesh = extract_surface(cells, labels, scene);
    EXPECT_EQ(mesh.positions, scene.positions);
    EXPECT_EQ(mesh.points, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(mesh.colors, scene.colors);
    ASSERT_EQ(mesh.faces.size(), 4U);
    EXPECT_NEAR(volume(mesh), 1.0 / 6.0, 1e-15);
}

TEST(ExtractSurface, HasNoColorsWhereThePointsHaveNone)
{
    Scene scene = bumpy_sphere(40, 5);
    const TetMesh cells = triangulate(scene);
    Labels labels(cells.cells.size(), Label::outside);
    labels[cells.cell_of_vertex[0]] = Label::inside;
    EXPECT_FALSE(extract_surface(cells, labels, scene).colors.empty());
    scene.colors.assign(scene.num_points(), {0, 0, 0});
    EXPECT_TRUE(extract_surface(cells, labels, scene).colors.empty());
}

TEST(ExtractSurface, EnclosesExactlyTheInsideForAnyLabels)
{
    const Scene scene = bumpy_sphere(300, 41);
    const TetMesh cells = triangulate(scene);
    std::mt19937 random(41);
    for (int round = 0; round < 20; ++round) {
        Labels labels(cells.cells.size(), Label::outside);
        double expected = 0.0;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const Cell& cell = cells.cells[i];
            if (cell.is_infinite() || random() % 3 != 0) {
                continue;
            }
            labels[i] = Label::inside;
            const Vector3d& a = cells.positions[cell.vertices[0]];
            expected += (cells.positions[cell.vertices[1]] - a)
                            .cross(cells.positions[cell.vertices[2]] - a)
                            .dot(cells.positions[cell.vertices[3]] - a) /
                        6.0;
        }
        const TriMesh mesh = extract_surface(cells, labels, scene);
        EXPECT_NEAR(volume(mesh), expected, 1e-12);
        EXPECT_EQ(check_mesh(mesh).boundary_edges, 0);
        EXPECT_EQ(check_mesh(mesh).unreferenced_vertices, 0);
    }
}

TEST(ExtractSurface, OfNothingInsideIsEmpty)
{
    const Scene scene = bumpy_sphere(50, 42);
    const TetMesh cells = triangulate(scene);
    const TriMesh mesh = extract_surface(cells, Labels(cells.cells.size(), Label::outside), scene);
    EXPECT_TRUE(mesh.faces.empty());
    EXPECT_TRUE(mesh.positions.empty());
}

/// A unit triangle in the plane z = 0, facing +z, seen by the views at `centers`.
struct SeenTriangle {
    Scene scene;
    TriMesh mesh;

    explicit SeenTriangle(const std::vector<Vector3d>& centers)
    {
        std::vector<std::uint32_t> all(centers.size());
        std::iota(all.begin(), all.end(), 0U);
        scene = make_scene(centers, {{{0, 0, 0}, all}, {{1, 0, 0}, all}, {{0, 1, 0}, all}});
        mesh.positions = scene.positions;
        mesh.colors = scene.colors;
        mesh.points = {0, 1, 2};
        mesh.faces = {{0, 1, 2}};
    }
};

TEST(ViewAgreement, CountsSightsOnTheFrontOfTheirFaces)
{
    const SeenTriangle seen({{0, 0, 5}, {0, 0, -5}, {3, 3, 1}});
    const ViewAgreement agreement = view_agreement(testing::half_edges(seen.mesh), seen.scene);
    EXPECT_EQ(agreement.sights, 9);
    EXPECT_EQ(agreement.facing, 6);
}

TEST(ViewAgreement, PassesOverCornersWithoutAPoint)
{
    SeenTriangle seen({{0, 0, 5}});
    seen.mesh.points[1] = kNoPoint;
    EXPECT_EQ(view_agreement(testing::half_edges(seen.mesh), seen.scene).sights, 2);
}

} // namespace
} // namespace vcarve::extract_test
