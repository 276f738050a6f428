#include "geometry/predicates.h"
#include "steps/1_points/arrange.h"
#include "steps/3_cells/triangulate.h"
#include "support/point_sets.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>

namespace vcarve::triangulate_test {
namespace {

using Eigen::Vector3d;

std::array<Index, 4> sorted(std::array<Index, 4> vertices)
{
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

/// Permutes points: point i of the result is point order[i].
Positions reordered(const Positions& points, const std::vector<Index>& order)
{
    Positions result;
    for (const Index i : order) {
        result.push_back(points[i]);
    }
    return result;
}

std::vector<Index> random_order(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) {
        std::swap(order[i - 1], order[pick(random, i)]);
    }
    return order;
}

TetMesh with_threads(int threads, const Positions& points)
{
    tbb::task_arena arena(threads);
    return arena.execute([&] { return triangulation_of(points); });
}

// ---- invariants of TetMesh ----------------------------------------------------------------------

/// Fails unless cells and their vertices are in canonical order.
void expect_canonical(const TetMesh& mesh)
{
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        const auto& v = mesh.cells[i].vertices;
        const auto ascending = sorted(v);
        ASSERT_LT(ascending[2], mesh.positions.size()) << "cell " << i;
        ASSERT_EQ(v[2], ascending[2]) << "cell " << i;
        ASSERT_EQ(v[3], ascending[3]) << "cell " << i; // so the infinite vertex is in slot 3
        if (i > 0) {
            ASSERT_LT(sorted(mesh.cells[i - 1].vertices), ascending) << "cell " << i;
        }
        if (!mesh.cells[i].is_infinite()) {
            ASSERT_EQ(orientation(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]],
                                  mesh.positions[v[3]]),
                      1)
                << "cell " << i;
        }
    }
}

/// Fails unless neighbors share the facet between them and are mutual.
void expect_mutual_neighbors(const TetMesh& mesh)
{
    ASSERT_EQ(mesh.mirrors.size(), mesh.cells.size());
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = mesh.cells[cell].neighbors[slot];
            ASSERT_LT(beyond, mesh.cells.size());
            const int mirror = mesh.mirror(cell, slot);
            ASSERT_EQ(mesh.cells[beyond].neighbors[mirror], cell);
            ASSERT_EQ(mesh.mirror(beyond, mirror), slot);
            // Both cells have the same vertices, except those opposite the facet.
            auto mine = mesh.cells[cell].vertices;
            auto theirs = mesh.cells[beyond].vertices;
            ASSERT_NE(mine[slot], theirs[mirror]);
            mine[slot] = theirs[mirror];
            ASSERT_EQ(sorted(mine), sorted(theirs)) << "cell " << cell << ", slot " << slot;
        }
    }
}

/// Fails unless each vertex has a finite cell that contains it.
void expect_cells_of_vertices(const TetMesh& mesh)
{
    ASSERT_EQ(mesh.cell_of_vertex.size(), mesh.positions.size());
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        ASSERT_LT(mesh.cell_of_vertex[vertex], mesh.cells.size());
        const Cell& cell = mesh.cells[mesh.cell_of_vertex[vertex]];
        ASSERT_FALSE(cell.is_infinite());
        ASSERT_EQ(std::count(cell.vertices.begin(), cell.vertices.end(), vertex), 1);
    }
}

/// Fails if a point is strictly inside the sphere around a cell, or beyond a facet of the hull.
void expect_delaunay(const TetMesh& mesh)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    for (const Vector3d& p : mesh.positions) {
        points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const Cell& cell : mesh.cells) {
        const auto& v = cell.vertices;
        for (Index i = 0; i < points.size(); ++i) {
            if (cell.is_infinite()) {
                ASSERT_LE(orientation(mesh.positions[v[0]], mesh.positions[v[1]],
                                      mesh.positions[v[2]], mesh.positions[i]),
                          0);
            } else {
                ASSERT_NE(CGAL::side_of_oriented_sphere(points[v[0]], points[v[1]], points[v[2]],
                                                        points[v[3]], points[i]),
                          CGAL::ON_POSITIVE_SIDE);
            }
        }
    }
}

void expect_sound(const TetMesh& mesh)
{
    expect_canonical(mesh);
    expect_mutual_neighbors(mesh);
    expect_cells_of_vertices(mesh);
    expect_delaunay(mesh);
}

/// Six times the volume of all finite cells; exact for small integer coordinates.
double volume_6(const TetMesh& mesh)
{
    double sum = 0.0;
    for (const Cell& cell : mesh.cells) {
        if (!cell.is_infinite()) {
            const Vector3d& o = mesh.positions[cell.vertices[0]];
            sum += (mesh.positions[cell.vertices[1]] - o)
                       .cross(mesh.positions[cell.vertices[2]] - o)
                       .dot(mesh.positions[cell.vertices[3]] - o);
        }
    }
    return sum;
}

void expect_equal(const TetMesh& a, const TetMesh& b)
{
    ASSERT_EQ(a.cells.size(), b.cells.size());
    for (std::size_t i = 0; i < a.cells.size(); ++i) {
        ASSERT_EQ(a.cells[i].vertices, b.cells[i].vertices) << "cell " << i;
        ASSERT_EQ(a.cells[i].neighbors, b.cells[i].neighbors) << "cell " << i;
    }
    EXPECT_EQ(a.mirrors, b.mirrors);
    EXPECT_EQ(a.cell_of_vertex, b.cell_of_vertex);
}

// ---- properties ---------------------------------------------------------------------------------

TEST(Triangulate, NumbersOneTetrahedronAsDocumented)
{
    // 0 1 2 are counter-clockwise seen from 3 only after 0 and 1 are swapped.
    const TetMesh mesh = triangulation_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}});
    using Four = std::array<Index, 4>;
    ASSERT_EQ(mesh.cells.size(), 5U);
    EXPECT_EQ(mesh.cells[0].vertices, (Four{1, 0, 2, 3}));
    EXPECT_EQ(mesh.cells[0].neighbors, (Four{3, 4, 2, 1}));
    // The corners of an infinite cell are counter-clockwise seen from outside the hull.
    EXPECT_EQ(mesh.cells[1].vertices, (Four{0, 1, 2, kInfinite}));
    EXPECT_EQ(mesh.cells[2].vertices, (Four{1, 0, 3, kInfinite}));
    EXPECT_EQ(mesh.cells[3].vertices, (Four{0, 2, 3, kInfinite}));
    EXPECT_EQ(mesh.cells[4].vertices, (Four{2, 1, 3, kInfinite}));
    EXPECT_EQ(mesh.cells[1].neighbors, (Four{4, 3, 2, 0}));
    EXPECT_EQ(mesh.mirrors[0], 0b11'11'11'11);
    EXPECT_EQ(mesh.cell_of_vertex, (std::vector<Index>{0, 0, 0, 0}));
    expect_sound(mesh);
}

TEST(Triangulate, PutsInfiniteCellsBeyondTheHull)
{
    for (const NamedCells& named : meshes_to_walk()) {
        const TetMesh& mesh = named.mesh;
        for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
            if (!mesh.cells[cell].is_infinite()) {
                continue;
            }
            const auto& v = mesh.cells[cell].vertices;
            const Index inner = mesh.cells[cell].neighbors[3];
            const Index apex = mesh.cells[inner].vertices[mesh.mirror(cell, 3)];
            ASSERT_EQ(orientation(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]],
                                  mesh.positions[apex]),
                      -1)
                << named.name << ", cell " << cell;
        }
    }
}

TEST(Triangulate, IsDelaunayAndCanonical)
{
    for (const NamedCells& named : meshes_to_walk()) {
        SCOPED_TRACE(named.name);
        expect_sound(named.mesh);
    }
}

TEST(Triangulate, FillsTheHullOfCosphericalPoints)
{
    const TetMesh cube = triangulation_of(lattice(2));
    expect_sound(cube);
    EXPECT_EQ(volume_6(cube), 6.0);
    const TetMesh cubes = triangulation_of(lattice(6));
    expect_sound(cubes);
    EXPECT_EQ(volume_6(cubes), 6.0 * 125.0);
    const TetMesh body_centered = triangulation_of(body_centered_lattice(4));
    expect_sound(body_centered);
    EXPECT_EQ(volume_6(body_centered), 6.0 * 27.0);
}

/// The corners of all cells, with their numbers before the permutation, in ascending order.
std::vector<std::array<Index, 4>> renamed_cells(const TetMesh& mesh,
                                                const std::vector<Index>& order)
{
    std::vector<std::array<Index, 4>> renamed;
    for (const Cell& cell : mesh.cells) {
        auto vertices = cell.vertices;
        for (Index& vertex : vertices) {
            vertex = vertex == kInfinite ? kInfinite : order[vertex];
        }
        renamed.push_back(sorted(vertices));
    }
    std::sort(renamed.begin(), renamed.end());
    return renamed;
}

TEST(Triangulate, HasTheSameCellsForPermutedPoints)
{
    Positions mixed = lattice(5);
    for (const Vector3d& point : mapped(random_points(60, 31), 4.0, Vector3d::Zero())) {
        mixed.push_back(point);
    }
    for (const Positions& points : {lattice(2), lattice(6), points_on_sphere(), mixed,
                                    body_centered_lattice(4), random_points(200, 32)}) {
        const TetMesh mesh = triangulation_of(points);
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const auto order = random_order(points.size(), seed);
            const TetMesh permuted = triangulation_of(reordered(points, order));
            ASSERT_EQ(permuted.cells.size(), mesh.cells.size());
            const std::vector<std::array<Index, 4>> renamed = renamed_cells(permuted, order);
            for (std::size_t i = 0; i < renamed.size(); ++i) {
                ASSERT_EQ(renamed[i], sorted(mesh.cells[i].vertices)) << points.size() << " points";
            }
        }
    }
}

TEST(Triangulate, ReturnsTheSameArraysForAnyInputOrder)
{
    for (const Positions& points :
         {lattice(6), points_on_sphere(), random_points(3000, 33), body_centered_lattice(5)}) {
        const Scene sorted = spatial_sort(scene_of(points));
        const TetMesh mesh = triangulate(sorted);
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const auto order = random_order(points.size(), seed);
            const Scene again = spatial_sort(scene_of(reordered(points, order)));
            ASSERT_EQ(again.positions, sorted.positions);
            expect_equal(triangulate(again), mesh);
        }
    }
}

TEST(Triangulate, ReturnsTheSameArraysAtEveryPowerOfTwo)
{
    for (const Positions& points : {lattice(5), points_on_sphere(), random_points(500, 34)}) {
        const TetMesh mesh = triangulation_of(points);
        for (const double factor : {0x1p-40, 0.5, 8.0, 0x1p40}) {
            SCOPED_TRACE(factor);
            expect_equal(triangulation_of(mapped(points, factor, Vector3d::Zero())), mesh);
        }
    }
}

TEST(Triangulate, ReturnsTheSameArraysForOneAndTwoThreads)
{
    expect_equal(with_threads(2, lattice(8)), with_threads(1, lattice(8)));
    // Enough points for blocks, some on a lattice and some in one plane.
    Positions points = mapped(random_points(48'000, 35), 14.0, Vector3d::Constant(0.0));
    for (const Vector3d& point : lattice(14)) {
        points.push_back(point);
    }
    for (std::size_t i = 0; i < 4000; ++i) {
        points[i].z() = 7.5;
    }
    points = spatial_sort(scene_of(points)).positions;
    const TetMesh one = with_threads(1, points);
    expect_canonical(one);
    expect_mutual_neighbors(one);
    expect_equal(with_threads(2, points), one);
}

TEST(Triangulate, UsesOneOrTwoBlocksPerThreadUnlessTheyAreSmall)
{
    EXPECT_EQ(usual_blocks(10'000'000, 1), 1U);
    EXPECT_EQ(usual_blocks(10'000'000, 2), 4U);
    EXPECT_EQ(usual_blocks(10'000'000, 16), 32U);
    EXPECT_EQ(usual_blocks(400'000, 2), 2U);
    EXPECT_EQ(usual_blocks(200'000, 16), 16U);
    EXPECT_EQ(usual_blocks(50'000, 16), 5U);
    EXPECT_EQ(usual_blocks(4, 2), 1U);
}

TEST(Triangulate, TriangulatesPointsOnOneSphereWithoutBlocks)
{
    const Positions points = spatial_sort(scene_of(nearly_on_a_sphere(20'000, 0.0))).positions;
    expect_equal(with_threads(2, points), with_threads(1, points));
}

// ---- errors -------------------------------------------------------------------------------------

std::string refusal_of(const Positions& points)
{
    return refusal<InputError>([&] { triangulation_of(points); });
}

TEST(Triangulate, RejectsMoreCellsThanTheLimit)
{
    const Scene scene = scene_of(two_skew_lines(40));
    const std::size_t all = triangulate(scene).cells.size();
    EXPECT_EQ(triangulate(scene, {}, all).cells.size(), all);
    EXPECT_THROW(triangulate(scene, {}, all - 1), InputError);
    const Scene many = scene_of(two_skew_lines(20'000)); // 400 million cells
    EXPECT_THROW(triangulate_at_once(many, {}, 100'000), InputError);
}

TEST(Triangulate, RejectsFewerThanFourPoints)
{
    EXPECT_EQ(refusal_of({}), "0 points passed the filter; a surface needs at least four that do "
                              "not lie in one plane");
    EXPECT_EQ(refusal_of({{1, 2, 3}}), "1 point passed the filter; a surface needs at least four "
                                       "that do not lie in one plane");
    EXPECT_EQ(refusal_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
              "3 points passed the filter; a surface needs at least four that do not lie in one "
              "plane");
}

TEST(Triangulate, RejectsCoplanarAndCollinearPoints)
{
    Positions plane = lattice(5);
    plane.resize(25);
    Positions line;
    for (int i = 0; i < 7; ++i) {
        line.emplace_back(0.1 * i, 0.1 * i, 0.1 * i);
    }
    const std::string rest =
        " points that passed the filter all lie in one plane; a surface needs at least four that "
        "do not";
    EXPECT_EQ(refusal_of(plane), "the 25" + rest);
    EXPECT_EQ(refusal_of(line), "the 7" + rest);
}

TEST(Triangulate, AcceptsFourPointsThatAreNotCoplanar)
{
    EXPECT_EQ(triangulation_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}}).cells.size(), 5U);
}

TEST(Triangulate, RejectsCoincidentPointsAsALogicError)
{
    Positions points = lattice(3);
    points.insert(points.begin(), 20, Vector3d(1, 1, 1));
    EXPECT_EQ(refusal<std::logic_error>([&] { triangulation_of(points); }),
              "two points to triangulate have the same position");
}

} // namespace
} // namespace vcarve::triangulate_test
