#include "mesh/check.h"
#include "mesh/half_edge_mesh.h"
#include "steps/6_surface/cleanup.h"
#include "support/tetra_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vcarve::cleanup_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using vcarve::testing::boundary_of;
using vcarve::testing::random_labels;
using vcarve::testing::tetra_grid;
using vcarve::testing::TetraGrid;
using vcarve::testing::volume;

constexpr CleanupOptions kKeepAll{.min_component = 0, .max_hole = 0};

struct Cleaned {
    TriMesh mesh;
    CleanupCounts counts;
};

Cleaned cleaned(const TriMesh& mesh, const CleanupOptions& options)
{
    const CleanSurface clean = clean_surface(mesh, options);
    Cleaned result{tri_mesh(*clean.mesh), clean.counts};
    EXPECT_EQ(result.counts.vertices, static_cast<std::int64_t>(result.mesh.positions.size()));
    EXPECT_EQ(result.counts.faces, static_cast<std::int64_t>(result.mesh.faces.size()));
    return result;
}

TriMesh octahedron()
{
    TriMesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                  {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    return mesh;
}

/// Adds the faces of `other`, moved along x.
void append(TriMesh& mesh, const TriMesh& other, double shift)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vector3d& position : other.positions) {
        mesh.positions.emplace_back(position + Vector3d(shift, 0, 0));
    }
    for (const Face& face : other.faces) {
        mesh.faces.push_back({first + face[0], first + face[1], first + face[2]});
    }
}

void expect_clean(const TriMesh& mesh)
{
    const MeshCheck check = check_mesh(mesh);
    ASSERT_EQ(check.nonmanifold_edges, 0);
    ASSERT_EQ(check.nonmanifold_vertices, 0);
    ASSERT_EQ(check.orientation_faults, 0);
    ASSERT_EQ(check.unreferenced_vertices, 0);
    ASSERT_EQ(check.degenerate_faces, 0);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const Vector3f& normal : mesh.normals) {
        ASSERT_TRUE(normal.isZero(0) || std::abs(normal.norm() - 1.0F) < 1e-6F) << normal;
    }
}

TEST(CleanSurface, OnlyAddsNormalsToAValidSurface)
{
    TriMesh mesh = octahedron();
    mesh.offset = {5e5, 4.6e6, 0};
    const Cleaned clean = cleaned(mesh, kKeepAll);
    EXPECT_EQ(clean.mesh.positions, mesh.positions);
    EXPECT_EQ(clean.mesh.faces, mesh.faces);
    EXPECT_EQ(clean.mesh.offset, mesh.offset);
    EXPECT_TRUE(clean.mesh.colors.empty());
    EXPECT_TRUE(clean.mesh.points.empty());
    for (std::size_t v = 0; v < 6; ++v) {
        EXPECT_EQ(clean.mesh.normals[v], mesh.positions[v].cast<float>());
    }
}

TEST(CleanSurface, AcceptsAnEmptySurface)
{
    const Cleaned clean = cleaned({}, {});
    EXPECT_TRUE(clean.mesh.positions.empty());
    EXPECT_TRUE(clean.mesh.faces.empty());
    EXPECT_EQ(clean.counts.removed_components, 0);
}

TEST(CleanSurface, DropsUnreferencedVerticesAndKeepsTheOrderOfOthers)
{
    TriMesh mesh = octahedron();
    mesh.positions.insert(mesh.positions.begin(), Vector3d(9, 9, 9));
    mesh.positions.insert(mesh.positions.begin() + 3, Vector3d(8, 8, 8));
    for (Face& face : mesh.faces) {
        for (std::uint32_t& v : face) {
            v += v < 2 ? 1 : 2;
        }
    }
    for (std::uint32_t v = 0; v < 8; ++v) {
        mesh.points.push_back(v);
        mesh.colors.push_back({static_cast<std::uint8_t>(v), 0, 0});
    }
    const Cleaned clean = cleaned(mesh, kKeepAll);
    EXPECT_EQ(clean.mesh.positions, octahedron().positions);
    EXPECT_EQ(clean.mesh.faces, octahedron().faces);
    EXPECT_EQ(clean.mesh.points, (std::vector<std::uint32_t>{1, 2, 4, 5, 6, 7}));
    EXPECT_EQ(clean.mesh.colors[2], (Color{4, 0, 0}));
    EXPECT_EQ(clean.counts.removed_vertices, 2);
}

/// A tetrahedron of a given size beside two octahedra with edges of 1.4.
TriMesh with_tetrahedron(double size)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    append(mesh, octahedron(), 10);
    append(mesh, octahedron(), 20);
    return mesh;
}

TEST(CleanSurface, RemovesSmallComponents)
{
    const TriMesh mesh = with_tetrahedron(5.0);
    const Cleaned some = cleaned(mesh, {.min_component = 8, .max_hole = 0});
    EXPECT_EQ(some.counts.removed_components, 1);
    EXPECT_EQ(some.counts.removed_vertices, 4);
    EXPECT_EQ(some.mesh.faces.size(), 16U);
    EXPECT_EQ(some.mesh.positions[0], Vector3d(11, 0, 0));
    const Cleaned all = cleaned(mesh, kKeepAll);
    EXPECT_EQ(all.counts.removed_components, 0);
    EXPECT_EQ(all.mesh.faces.size(), 20U);
}

TEST(CleanSurface, RemovesCompactComponentsBelowHalfTheLimit)
{
    const auto num_removed = [](const TriMesh& mesh, int min_faces) {
        const CleanupOptions options{.min_component = min_faces, .max_hole = 0};
        return cleaned(mesh, options).counts.removed_components;
    };
    EXPECT_EQ(num_removed(with_tetrahedron(1.0), 8), 0);
    EXPECT_EQ(num_removed(with_tetrahedron(1.0), 9), 1);
    EXPECT_EQ(num_removed(with_tetrahedron(1.9), 8), 0);
    EXPECT_EQ(num_removed(with_tetrahedron(2.1), 8), 1) << "its edges have length 3";
    EXPECT_EQ(num_removed(with_tetrahedron(2.1), 4), 0);
    TriMesh open = with_tetrahedron(1.0);
    open.faces.erase(open.faces.begin());
    EXPECT_EQ(num_removed(open, 6), 1);
    EXPECT_EQ(num_removed(open, 3), 0);
}

TEST(CleanSurface, NeverRemovesTheLargestComponent)
{
    TriMesh mesh = octahedron();
    append(mesh, octahedron(), 10);
    const Cleaned clean = cleaned(mesh, {.min_component = 1000, .max_hole = 0});
    EXPECT_EQ(clean.counts.removed_components, 1);
    EXPECT_EQ(clean.mesh.positions, octahedron().positions);
}

TEST(CleanSurface, FillsHolesUpToMaxHole)
{
    const TetraGrid grid = tetra_grid(3);
    TriMesh mesh = boundary_of(grid, std::vector<bool>(grid.cells.size(), true));
    const double whole = volume(mesh);
    // Remove the central square of the lower side, which leaves a hole of four edges.
    std::erase_if(mesh.faces, [&](const Face& face) {
        return std::ranges::all_of(face, [&](std::uint32_t v) {
            const Vector3d& p = mesh.positions[v];
            return p.z() == 0 && p.x() >= 1 && p.x() <= 2 && p.y() >= 1 && p.y() <= 2;
        });
    });
    EXPECT_EQ(check_mesh(mesh).boundary_edges, 4);
    const Cleaned open = cleaned(mesh, {.min_component = 0, .max_hole = 3});
    EXPECT_EQ(open.counts.filled_holes, 0);
    EXPECT_EQ(check_mesh(open.mesh).boundary_edges, 4);
    const Cleaned filled = cleaned(mesh, {.min_component = 0, .max_hole = 4});
    EXPECT_EQ(filled.counts.filled_holes, 1);
    EXPECT_TRUE(check_mesh(filled.mesh).is_closed());
    EXPECT_NEAR(volume(filled.mesh), whole, 1e-12);
    expect_clean(filled.mesh);
}

TEST(CleanSurface, KeepsTheOuterBoundaryOfAPatch)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    const Cleaned clean = cleaned(mesh, {});
    EXPECT_EQ(clean.counts.filled_holes, 0);
    EXPECT_EQ(clean.mesh.faces, mesh.faces);
}

TEST(CleanSurface, FillsNoHolesOfRemovedComponents)
{
    TriMesh mesh = octahedron();
    TriMesh open = octahedron();
    open.faces.pop_back();
    append(mesh, open, 10);
    const Cleaned clean = cleaned(mesh, {.min_component = 8, .max_hole = 12});
    EXPECT_EQ(clean.counts.filled_holes, 0);
    EXPECT_EQ(clean.mesh.faces, octahedron().faces);
}

TEST(CleanSurface, WritesZeroNormalsForFacesWithoutArea)
{
    TriMesh mesh = octahedron();
    for (Vector3d& position : mesh.positions) {
        position = {position.x(), position.x(), position.x()}; // collinear
    }
    const Cleaned clean = cleaned(mesh, kKeepAll);
    EXPECT_EQ(clean.mesh.normals, std::vector<Vector3f>(6, Vector3f::Zero()));
}

TEST(CleanSurface, CleansAnyLabelingAndKeepsClosedSurfacesClosed)
{
    const TetraGrid grid = tetra_grid(3);
    std::mt19937 random(21);
    std::int64_t num_filled = 0;
    for (int round = 0; round < 300; ++round) {
        TriMesh mesh =
            boundary_of(grid, random_labels(grid.cells.size(), 0.2 + 0.1 * (round % 7), random));
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            mesh.colors.push_back({static_cast<std::uint8_t>(v), 1, 2});
            mesh.points.push_back(v);
        }
        if (round % 2 == 1)
            std::erase_if(mesh.faces, [&](const Face&) { return random() % 16 == 0; });
        const bool is_open = check_mesh(mesh).boundary_edges > 0;
        const Cleaned clean = cleaned(mesh, {});
        ASSERT_NO_FATAL_FAILURE(expect_clean(clean.mesh)) << "round " << round;
        if (!is_open) {
            ASSERT_EQ(check_mesh(clean.mesh).boundary_edges, 0) << "round " << round;
        }
        for (std::size_t v = 0; v < clean.mesh.positions.size(); ++v) {
            const std::uint32_t point = clean.mesh.points[v];
            if (point == kNoPoint) continue;
            ASSERT_EQ(clean.mesh.positions[v], mesh.positions[point]);
            ASSERT_EQ(clean.mesh.colors[v], mesh.colors[point]);
        }
        num_filled += clean.counts.filled_holes;
    }
    EXPECT_GT(num_filled, 400);
}

TEST(CleanSurface, CleansAnySoup)
{
    std::mt19937 random(23);
    for (int round = 0; round < 600; ++round) {
        TriMesh mesh;
        const std::size_t num_vertices = 3 + random() % 6;
        for (std::size_t v = 0; v < num_vertices; ++v) {
            mesh.positions.emplace_back(random() % 4, random() % 4, random() % 4);
        }
        for (std::size_t f = random() % 40; f > 0; --f) {
            const auto vertex = [&] { return static_cast<std::uint32_t>(random() % num_vertices); };
            mesh.faces.push_back({vertex(), vertex(), vertex()});
        }
        const Cleaned clean = cleaned(mesh, {.min_component = round % 3, .max_hole = 12});
        ASSERT_NO_FATAL_FAILURE(expect_clean(clean.mesh)) << "round " << round;
    }
}

TEST(CleanSurface, ScalesWithTheSurface)
{
    const TetraGrid grid = tetra_grid(3);
    std::mt19937 random(22);
    TriMesh mesh = boundary_of(grid, random_labels(grid.cells.size(), 0.5, random));
    std::erase_if(mesh.faces, [&](const Face&) { return random() % 16 == 0; });
    TriMesh scaled = mesh;
    for (Vector3d& position : scaled.positions) {
        position *= std::pow(2.0, 20);
    }
    const Cleaned expected = cleaned(mesh, {});
    const Cleaned clean = cleaned(scaled, {});
    EXPECT_EQ(clean.mesh.faces, expected.mesh.faces);
    EXPECT_EQ(clean.mesh.normals, expected.mesh.normals);
    EXPECT_EQ(clean.mesh.positions[5], expected.mesh.positions[5] * std::pow(2.0, 20));
}

TEST(DropSmallComponents, DropsComponentsOfLessAreaButNeverTheLargest)
{
    TriMesh mesh;
    for (const double size : {1.0, 2.0, 3.0}) { // areas 0.5, 2 and 4.5
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(0.0, 0.0, 10.0 * size);
        mesh.positions.emplace_back(size, 0.0, 10.0 * size);
        mesh.positions.emplace_back(0.0, size, 10.0 * size);
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    TriMesh kept = mesh;
    EXPECT_EQ(drop_small_components(kept, 2.0), 1);
    EXPECT_EQ(kept.faces, (std::vector<Face>{{3, 4, 5}, {6, 7, 8}}));
    EXPECT_EQ(drop_small_components(mesh, 1e6), 2);
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{6, 7, 8}}));
}

} // namespace
} // namespace vcarve::cleanup_test
