#include "mesh/check.h"
#include "steps/6_surface/split_nonmanifold.h"
#include "support/tetra_grid.h"

#include <gtest/gtest.h>

#include <numeric>

namespace vcarve::split_nonmanifold_test {
namespace {

using Eigen::Vector3d;
using testing::boundary_of;
using testing::random_labels;
using testing::tetra_grid;
using testing::TetraGrid;
using testing::volume;

/// Assigns distinct colors and points to the vertices.
void mark_vertices(TriMesh& mesh)
{
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        mesh.colors.push_back({static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(10 * v), 7});
        mesh.points.push_back(100 + v);
    }
}

void expect_sound(const TriMesh& mesh)
{
    const MeshCheck check = check_mesh(mesh);
    ASSERT_EQ(check.nonmanifold_edges, 0);
    ASSERT_EQ(check.nonmanifold_vertices, 0);
    ASSERT_EQ(check.orientation_faults, 0);
    ASSERT_EQ(check.degenerate_faces, 0);
}

/// Two tetrahedra on opposite sides of the edge 0 1, which is all they share.
TriMesh two_wedges()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, -0.1, 0}, {1, 0.1, 0}, {-1, 0.1, 0}, {-1, -0.1, 0}};
    mesh.faces = {{0, 1, 3}, {1, 0, 2}, {0, 3, 2}, {1, 2, 3},
                  {0, 1, 5}, {1, 0, 4}, {0, 5, 4}, {1, 4, 5}};
    mark_vertices(mesh);
    return mesh;
}

/// Expects that twins run in opposite directions, except at boundaries.
void expect_mates(const ManifoldSurface& split)
{
    const std::vector<Face>& faces = split.mesh.faces;
    ASSERT_EQ(split.twins.size(), 3 * faces.size());
    for (HalfEdge half_edge = 0; half_edge < split.twins.size(); ++half_edge) {
        const HalfEdge twin = split.twins[half_edge];
        if (twin == kNoHalfEdge) continue;
        ASSERT_EQ(split.twins[twin], half_edge);
        ASSERT_EQ(tail(faces, twin), head(faces, half_edge));
        ASSERT_EQ(head(faces, twin), tail(faces, half_edge));
    }
    ASSERT_EQ(std::ranges::count(split.twins, kNoHalfEdge), check_mesh(split.mesh).boundary_edges);
}

TEST(SplitNonmanifold, KeepsAManifoldSurfaceUnchanged)
{
    const TetraGrid grid = tetra_grid(1);
    TriMesh mesh = boundary_of(grid, std::vector<bool>(grid.cells.size(), true));
    mark_vertices(mesh);
    const ManifoldSurface split = split_nonmanifold(mesh);
    EXPECT_EQ(split.mesh.positions, mesh.positions);
    EXPECT_EQ(split.mesh.faces, mesh.faces);
    EXPECT_EQ(split.mesh.colors, mesh.colors);
    EXPECT_EQ(split.mesh.points, mesh.points);
    EXPECT_EQ(split.split_edges, 0);
    EXPECT_EQ(split.split_vertices, 0);
}

TEST(SplitNonmanifold, AcceptsAnEmptySurface)
{
    EXPECT_TRUE(split_nonmanifold({}).mesh.faces.empty());
}

TEST(SplitNonmanifold, KeepsTheFacesOfEachSolidTogetherAtASharedEdge)
{
    const ManifoldSurface split = split_nonmanifold(two_wedges());
    EXPECT_EQ(split.split_edges, 1);
    EXPECT_EQ(split.split_vertices, 2);
    EXPECT_EQ(split.mesh.faces, (std::vector<Face>{{0, 1, 3},
                                                   {1, 0, 2},
                                                   {0, 3, 2},
                                                   {1, 2, 3},
                                                   {6, 7, 5},
                                                   {7, 6, 4},
                                                   {6, 5, 4},
                                                   {7, 4, 5}}));
    EXPECT_EQ(split.mesh.positions[6], Vector3d(0, 0, 0));
    EXPECT_EQ(split.mesh.positions[7], Vector3d(0, 0, 1));
    EXPECT_EQ(split.mesh.points,
              (std::vector<std::uint32_t>{100, 101, 102, 103, 104, 105, 100, 101}));
    EXPECT_EQ(split.mesh.colors[7], (Color{1, 10, 7}));
    expect_sound(split.mesh);
}

TEST(SplitNonmanifold, KeepsSolidsTogetherAcrossThinGaps)
{
    // The gaps and solids are wedges of about 1e-15, which rounded angles cannot order.
    TriMesh mesh;
    const double step = 1.0 / (1LL << 50);
    mesh.positions = {{0, 0, 0}, {0, 0, 1}};
    for (int i = 0; i < 6; ++i) {
        mesh.positions.emplace_back(1.0, i * step, 0.5);
    }
    for (std::uint32_t i = 6; i >= 2; i -= 2) { // a solid with the apexes i and i + 1
        mesh.faces.push_back({0, 1, i + 1});
        mesh.faces.push_back({1, 0, i});
        mesh.faces.push_back({0, i + 1, i});
        mesh.faces.push_back({1, i, i + 1});
    }
    const ManifoldSurface split = split_nonmanifold(mesh);
    expect_sound(split.mesh);
    const MeshCheck check = check_mesh(split.mesh);
    EXPECT_EQ(check.components, 3);
    EXPECT_TRUE(check.is_closed());
}

TEST(SplitNonmanifold, SeparatesSolidsThatTouchInAVertex)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                      {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2},
                  {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}};
    const ManifoldSurface split = split_nonmanifold(mesh);
    EXPECT_EQ(split.split_edges, 0);
    EXPECT_EQ(split.split_vertices, 1);
    EXPECT_EQ(split.mesh.positions.size(), 8U);
    EXPECT_EQ(split.mesh.faces[4], (Face{7, 4, 5}));
    expect_sound(split.mesh);
}

TEST(SplitNonmanifold, LeavesABoundaryIfTheOtherFaceOfASectorIsMissing)
{
    TriMesh mesh = two_wedges();
    mesh.faces.erase(mesh.faces.begin() + 5); // {1, 0, 4}
    const ManifoldSurface split = split_nonmanifold(mesh);
    expect_sound(split.mesh);
    EXPECT_EQ(split.split_edges, 1);
    EXPECT_EQ(check_mesh(split.mesh).components, 2);
    EXPECT_EQ(check_mesh(split.mesh).boundary_edges, 3);
}

TEST(SplitNonmanifold, SplitsSeamsBetweenTheSameVerticesAtAMidpoint)
{
    TriMesh mesh = two_wedges();
    // Connect the outer faces of the wedges around both vertices of the edge, so that these cannot
    // be separated.
    mesh.faces = {{0, 1, 3}, {1, 0, 2}, {0, 1, 5}, {1, 0, 4},
                  {0, 3, 4}, {1, 4, 3}, {0, 5, 2}, {1, 2, 5}};
    // Around the edge, 0 1 3 closes the sector of 1 0 2, and 0 1 5 that of 1 0 4. Each vertex has
    // one disk of faces (3 4 5 2), so two seams still share the edge.
    const ManifoldSurface split = split_nonmanifold(mesh);
    expect_sound(split.mesh);
    EXPECT_EQ(split.split_edges, 1);
    EXPECT_EQ(split.split_vertices, 0);
    ASSERT_EQ(split.mesh.positions.size(), 7U);
    EXPECT_EQ(split.mesh.positions[6], Vector3d(0, 0, 0.5));
    EXPECT_EQ(split.mesh.colors[6], (Color{1, 5, 7}));
    EXPECT_EQ(split.mesh.points[6], kNoPoint);
    EXPECT_EQ(split.mesh.faces.size(), 10U);
    EXPECT_TRUE(check_mesh(split.mesh).is_closed());
    EXPECT_NEAR(volume(split.mesh), volume(mesh), 1e-15);
}

TEST(SplitNonmanifold, DropsDegenerateFaces)
{
    TriMesh mesh = two_wedges();
    mesh.faces.push_back({2, 2, 3});
    EXPECT_EQ(split_nonmanifold(mesh).mesh.faces.size(), 8U);
}

TEST(SplitNonmanifold, MakesTheBoundaryOfAnyLabelingManifold)
{
    const TetraGrid grid = tetra_grid(3);
    std::mt19937 random(11);
    std::int64_t num_edges = 0;
    std::int64_t num_midpoints = 0;
    for (int round = 0; round < 400; ++round) {
        const double share = 0.1 + 0.8 * (round % 9) / 8.0;
        const TriMesh mesh = boundary_of(grid, random_labels(grid.cells.size(), share, random));
        const ManifoldSurface split = split_nonmanifold(mesh);
        const MeshCheck before = check_mesh(mesh);
        const MeshCheck after = check_mesh(split.mesh);
        ASSERT_NO_FATAL_FAILURE(expect_sound(split.mesh)) << "round " << round;
        ASSERT_EQ(after.boundary_edges, 0) << "round " << round;
        ASSERT_EQ(split.split_edges, before.nonmanifold_edges) << "round " << round;
        ASSERT_NEAR(volume(split.mesh), volume(mesh), 1e-9) << "round " << round;
        ASSERT_NEAR(after.area, before.area, 1e-9) << "round " << round;
        num_edges += split.split_edges;
        num_midpoints += (after.faces - before.faces) / 2;
    }
    // These labelings are difficult and include all cases.
    EXPECT_GT(num_edges, 10000);
    EXPECT_GT(num_midpoints, 100);
}

TEST(SplitNonmanifold, SeparatesSolidsThatShareNoFacet)
{
    // Only facets connect cells; vertices and edges do not. So if no two cells share a facet, each
    // cell is one component of the surface.
    const TetraGrid grid = tetra_grid(2);
    std::vector<bool> inside(grid.cells.size(), false);
    std::int64_t num_cells = 0;
    for (std::size_t c = 0; c < grid.cells.size(); ++c) {
        inside[c] = true;
        const TriMesh mesh = boundary_of(grid, inside);
        if (mesh.faces.size() == 4 * static_cast<std::size_t>(num_cells + 1)) {
            ++num_cells;
        } else {
            inside[c] = false;
        }
    }
    const ManifoldSurface split = split_nonmanifold(boundary_of(grid, inside));
    EXPECT_EQ(check_mesh(split.mesh).components, num_cells);
    EXPECT_EQ(split.mesh.positions.size() - check_mesh(split.mesh).unreferenced_vertices,
              4 * static_cast<std::size_t>(num_cells));
    EXPECT_GT(split.split_edges, 10);
}

TEST(SplitNonmanifold, MakesAnySubsetOfABoundaryManifold)
{
    const TetraGrid grid = tetra_grid(2);
    std::mt19937 random(12);
    for (int round = 0; round < 600; ++round) {
        TriMesh mesh = boundary_of(grid, random_labels(grid.cells.size(), 0.5, random));
        std::erase_if(mesh.faces, [&](const Face&) { return random() % 8 == 0; });
        const ManifoldSurface split = split_nonmanifold(mesh);
        ASSERT_NO_FATAL_FAILURE(expect_sound(split.mesh)) << "round " << round;
        ASSERT_NEAR(check_mesh(split.mesh).area, check_mesh(mesh).area, 1e-9);
    }
}

TEST(SplitNonmanifold, MakesAnySoupManifold)
{
    std::mt19937 random(13);
    for (int round = 0; round < 600; ++round) {
        TriMesh mesh = {};
        const std::size_t num_vertices = 3 + random() % 6;
        for (std::size_t v = 0; v < num_vertices; ++v) {
            mesh.positions.emplace_back(random() % 4, random() % 4, random() % 4);
        }
        for (std::size_t f = random() % 40; f > 0; --f) {
            const auto vertex = [&] { return static_cast<std::uint32_t>(random() % num_vertices); };
            mesh.faces.push_back({vertex(), vertex(), vertex()});
        }
        const ManifoldSurface split = split_nonmanifold(mesh);
        ASSERT_NO_FATAL_FAILURE(expect_sound(split.mesh)) << "round " << round;
        ASSERT_NO_FATAL_FAILURE(expect_mates(split)) << "round " << round;
    }
}

} // namespace
} // namespace vcarve::split_nonmanifold_test
