#include "steps/1_points/arrange.h"
#include "steps/3_cells/block_cells.h"
#include "steps/3_cells/triangulate.h"
#include "steps/3_cells/triangulate_blocks.h"
#include "support/point_sets.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <string>
#include <vector>

namespace vcarve::triangulate_blocks_test {
namespace {

using Eigen::Vector3d;

struct NamedPoints {
    std::string name;
    Positions points;
};

/// A terrain of small height over a square grid: flat on a large scale, with cocircular points on a
/// small scale.
Positions terrain(int n, double height)
{
    Positions points;
    std::mt19937_64 random(71);
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            points.emplace_back(x, y, height * std::floor(even(random, 0.0, 5.0)));
        }
    }
    return points;
}

/// A dense cluster, and points far from it and from each other.
Positions with_outliers()
{
    Positions points = mapped(random_points(800, 73), 1e-3, Vector3d(5.0, 5.0, 5.0));
    for (const Vector3d& far : mapped(random_points(60, 74), 1e4, Vector3d::Constant(-5e3)))
        points.push_back(far);
    return points;
}

/// Coplanar points and one other.
Positions plane_and_a_point()
{
    Positions points = lattice(12);
    points.resize(144);
    points.emplace_back(3.5, 2.25, 1e-9);
    return points;
}

std::vector<NamedPoints> point_sets()
{
    return {
        {"anywhere", random_points(3000, 75)},
        {"a lattice", lattice(11)},
        {"a body-centered lattice", body_centered_lattice(7)},
        {"on a sphere", points_on_sphere()},
        {"nearly on a sphere", nearly_on_a_sphere(600, 1e-12)},
        {"a rough ball", nearly_on_a_sphere(2500, 0.01)},
        {"a terrain on a raster", terrain(40, 1.0)},
        {"a flat terrain", terrain(30, 1e-9)},
        {"outliers", with_outliers()},
        {"a plane and a point", plane_and_a_point()},
        {"far from the origin", mapped(random_points(1000, 76), 1.0, Vector3d(5e5, 4.6e6, 100))},
        {"tiny", mapped(random_points(1000, 77), 0x1p-120, Vector3d::Zero())},
        {"huge", mapped(random_points(1000, 78), 0x1p120, Vector3d::Zero())},
        {"few", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}}};
}

TetMesh in_blocks(const Scene& scene, std::size_t count)
{
    std::optional<TetMesh> mesh = triangulate_in_blocks(scene, {.count = count});
    EXPECT_TRUE(mesh.has_value());
    return mesh.value_or(TetMesh());
}

void expect_equal(const TetMesh& a, const TetMesh& b)
{
    ASSERT_EQ(a.cells.size(), b.cells.size());
    for (std::size_t i = 0; i < a.cells.size(); ++i) {
        ASSERT_EQ(a.cells[i].vertices, b.cells[i].vertices) << "cell " << i;
        ASSERT_EQ(a.cells[i].neighbors, b.cells[i].neighbors) << "cell " << i;
    }
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.mirrors, b.mirrors);
    EXPECT_EQ(a.cell_of_vertex, b.cell_of_vertex);
}

TEST(TriangulateBlocks, ReturnsTheCellsOfTheWhole)
{
    for (const NamedPoints& named : point_sets()) {
        const Scene scene = spatial_sort(scene_of(named.points));
        const TetMesh whole = triangulate(scene);
        for (const std::size_t blocks : {1, 2, 3, 8, 64}) {
            SCOPED_TRACE(named.name + ", " + std::to_string(blocks) + " blocks");
            expect_equal(in_blocks(scene, blocks), whole);
        }
    }
}

TEST(TriangulateBlocks, ReturnsTheCellsOfTheWholeWithOnePointPerBlock)
{
    for (const Positions& points : {lattice(4), random_points(70, 79), points_on_sphere()}) {
        const Scene scene = spatial_sort(scene_of(points));
        const TetMesh whole = triangulate(scene);
        expect_equal(in_blocks(scene, scene.num_points()), whole);
        expect_equal(in_blocks(scene, 10 * scene.num_points()), whole);
    }
}

/// Blocks then overlap in space, which is slow but must be correct.
TEST(TriangulateBlocks, ReturnsTheCellsOfTheWholeForUnsortedPoints)
{
    const Scene scene = scene_of(random_points(400, 80));
    expect_equal(in_blocks(scene, 5), triangulate(scene));
}

TEST(TriangulateBlocks, ReturnsTheSameForAnyThreadCount)
{
    const Scene scene = spatial_sort(scene_of(random_points(4000, 81)));
    const auto with_threads = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return in_blocks(scene, 7); });
    };
    expect_equal(with_threads(1), with_threads(2));
}

TEST(TriangulateBlocks, NeedsFewPointsOfOtherBlocks)
{
    // A block of an eighth of 20,000 points is surrounded by about 600, which is about one layer.
    const Scene scene = spatial_sort(scene_of(random_points(20'000, 82)));
    const PointTree tree(scene.positions);
    const std::vector<Index> first = first_points(scene.positions);
    const PointRun own{5000, 7500};
    ProgressCount silent({}, own.size());
    CellCount count(kAnyCells);
    BlockProgress progress(silent, own.size());
    const BlockCells block = block_cells(tree, first, own, count, progress);
    EXPECT_LT(block.taken_in, own.size());
    EXPECT_GT(block.taken_in, own.size() / 10);
}

TEST(TriangulateBlocks, CountsTheCellsOfAllGrowingBlocks)
{
    const Scene scene = scene_of(two_skew_lines(100));
    const std::size_t all = triangulate(scene).cells.size();
    EXPECT_GT(all, 99U * 99U);
    tbb::task_arena alone(1);
    const auto in_four = [&](std::size_t most_cells) {
        return alone.execute([&] {
            return triangulate_in_blocks(scene, {.count = 4, .most_cells = most_cells})
                ->cells.size();
        });
    };
    // Every block needs almost all points here.
    EXPECT_EQ(in_four(2 * all), all);
    EXPECT_THROW(in_four(3 * all / 2), InputError);
    EXPECT_EQ(refusal<InputError>([&] { in_four(5000); }),
              "the points have more than 5000 cells, all that --max-memory allows, because many "
              "lie on few lines or curves; raise --max-memory");
}

TEST(TriangulateBlocks, RejectsTheSamePointsAsTheWhole)
{
    Positions plane = lattice(5);
    plane.resize(25);
    Positions doubled = lattice(3);
    doubled.insert(doubled.begin(), 20, Vector3d(1, 1, 1));
    for (const Positions& points : {Positions{}, lattice(1), plane}) {
        const Scene scene = scene_of(points);
        EXPECT_EQ(refusal<InputError>([&] { in_blocks(scene, 2); }),
                  refusal<InputError>([&] { triangulate(scene); }));
    }
    EXPECT_EQ(refusal<std::logic_error>([&] { in_blocks(scene_of(doubled), 2); }),
              "two points to triangulate have the same position");
}

/// The sphere of each cell has almost all points on it.
TEST(TriangulateBlocks, GivesUpOnPointsOnOneSphere)
{
    const Scene scene = spatial_sort(scene_of(nearly_on_a_sphere(10'000, 0.0)));
    EXPECT_FALSE(triangulate_in_blocks(scene, {.count = 4}).has_value());
}

TEST(FirstPoints, SpanSpace)
{
    Positions points = plane_and_a_point();
    std::swap(points[100], points.back());
    const std::vector<Index> first = first_points(points);
    EXPECT_TRUE(std::ranges::binary_search(first, Index{100}));
    EXPECT_TRUE(std::ranges::is_sorted(first));
    EXPECT_EQ(first_points(lattice(1)).size(), 1U);
}

} // namespace
} // namespace vcarve::triangulate_blocks_test
