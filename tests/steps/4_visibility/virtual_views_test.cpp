#include "base/numbers.h"
#include "geometry/predicates.h"
#include "io/colmap/colmap_model.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/ray_weights.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/virtual_views.h"
#include "steps/4_visibility/walk.h"
#include "steps/5_labels/label_cells.h"
#include "support/cast_rays.h"
#include "support/exact_ray.h"
#include "support/places.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vcarve::virtual_views_test {
namespace {

using Eigen::Vector3d;

Scene paper_object(const std::string& name)
{
    return read_colmap_model(fixtures_folder() / "paper" / name, ModelFormat::text);
}

/// The scene with the rays of two views only. All points stay, so that the true solid still
/// consists of whole cells; most points lose all rays.
Scene seen_by_two(const Scene& scene, std::uint32_t first, std::uint32_t second)
{
    Scene result = scene;
    result.tracks = {};
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        std::vector<std::uint32_t> row;
        std::ranges::copy_if(scene.tracks[point], std::back_inserter(row),
                             [&](std::uint32_t view) { return view == first || view == second; });
        result.tracks.push_back(row);
    }
    return result;
}

double volume(const TetMesh& mesh, Index cell)
{
    const auto& v = mesh.cells[cell].vertices;
    const Vector3d& a = mesh.positions[v[0]];
    return (mesh.positions[v[1]] - a)
               .dot((mesh.positions[v[2]] - a).cross(mesh.positions[v[3]] - a)) /
           6.0;
}

/// The errors of a labeling.
struct Faults {
    int left = 0; ///< empty cells that are labeled inside
    double left_volume = 0.0;
    int lost = 0; ///< solid cells that are labeled outside

    Faults& operator+=(const Faults& more)
    {
        left += more.left;
        left_volume += more.left_volume;
        lost += more.lost;
        return *this;
    }
};

Faults faults_of(const TetMesh& mesh, const Labels& labels, const Labels& truth)
{
    Faults faults;
    for (Index cell = 0; cell < labels.size(); ++cell) {
        if (labels[cell] == Label::inside && truth[cell] == Label::outside) {
            ++faults.left;
            faults.left_volume += volume(mesh, cell);
        }
        faults.lost += labels[cell] == Label::outside && truth[cell] == Label::inside ? 1 : 0;
    }
    return faults;
}

class VirtualViews : public ::testing::Test {
  protected:
    VirtualRays virtual_rays_of(const Scene& scene, const TetMesh& mesh, const Labels& labels,
                                int count)
    {
        return find_virtual_rays(mesh, scene, labels, {.count = count, .weight = 0.5}, stage_);
    }

    Log log_;
    Stage stage_ = Stage(log_, "a test");
};

// ---- carving with two views (figure 13 of the paper) --------------------------------------------

TEST_F(VirtualViews, CarvesEmptyCellsThatTwoViewsMiss)
{
    const Scene scene = paper_object("cube_with_cavity");
    const TetMesh mesh = triangulate(scene);
    const Labels truth = carve(mesh, crossings_of(mesh, scene), 1);
    Faults before;
    Faults after;
    int wrong_pairs = 0;
    int mended_pairs = 0;
    for (std::uint32_t a = 0; a < scene.views.size(); ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            const Scene two = seen_by_two(scene, a, b);
            Crossings crossings = crossings_of(mesh, two);
            const Labels first = carve(mesh, crossings, 1);
            CrossingCounter(mesh).cast(virtual_rays_of(two, mesh, first, 20).source(0.5), crossings,
                                       stage_);
            const Faults left = faults_of(mesh, first, truth);
            const Faults still_left = faults_of(mesh, carve(mesh, crossings, 1), truth);
            before += left;
            after += still_left;
            wrong_pairs += left.left > 0 ? 1 : 0;
            mended_pairs += left.left > 0 && still_left.left == 0 ? 1 : 0;
        }
    }
    // There are 190 pairs of views, each with 41 empty cells, which are 10 cubed units in all.
    EXPECT_EQ(wrong_pairs, 189);
    EXPECT_EQ(mended_pairs, 65);
    EXPECT_EQ(before.left, 2564);
    EXPECT_NEAR(before.left_volume, 541.1, 0.1);
    EXPECT_EQ(after.left, 1655);
    EXPECT_NEAR(after.left_volume, 368.7, 0.1);
    EXPECT_EQ(before.lost, 0);
    EXPECT_EQ(after.lost, 0);
}

// ---- positions and visible points ---------------------------------------------------------------

bool holds(const TetMesh& mesh, const Cell& cell, const Vector3d& place)
{
    if (cell.is_infinite()) return false;
    for (const auto& [a, b, c] : kFacetCorners) {
        if (orientation(mesh.positions[cell.vertices[a]], mesh.positions[cell.vertices[b]],
                        mesh.positions[cell.vertices[c]], place) <= 0) {
            return false;
        }
    }
    return true;
}

TEST_F(VirtualViews, PlacesViewpointsInDistinctOutsideCellsThatRaysCross)
{
    const Scene scene = seen_by_two(paper_object("desk"), 3, 7);
    const TetMesh mesh = triangulate(scene);
    const Crossings crossings = crossings_of(mesh, scene);
    const Labels labels = carve(mesh, crossings, 2); // some inside cells are crossed by one ray
    const VirtualRays rays = virtual_rays_of(scene, mesh, labels, 25);
    ASSERT_EQ(rays.centers.size(), 25U);
    std::set<Index> cells;
    for (const Vector3d& center : rays.centers) {
        for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
            if (!holds(mesh, mesh.cells[cell], center)) continue;
            cells.insert(cell);
            EXPECT_EQ(labels[cell], Label::outside);
            EXPECT_GE(std::ranges::max(crossings[cell]), 2U);
        }
    }
    EXPECT_EQ(cells.size(), 25U);
}

/// The distance from the centroid of a cell to its nearest corner.
double clearance(const TetMesh& mesh, const Cell& cell)
{
    Vector3d middle = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        middle += mesh.positions[vertex] / 4.0;
    }
    double least = kUnlimited;
    for (const Index vertex : cell.vertices) {
        least = std::min(least, (mesh.positions[vertex] - middle).norm());
    }
    return least;
}

TEST_F(VirtualViews, PlacesNoViewpointAtTheSurfaceOrFarOff)
{
    // A plate of points a unit apart, and four points high above: free cells of all sizes between.
    std::vector<MadePoint> points;
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 10; ++j) {
            const double uneven = 0.1 * std::sin(7.0 * i + 3.0 * j * j);
            points.push_back({{i + uneven, j - uneven, uneven}, {0, 1}});
        }
    }
    for (const Vector3d& high :
         {Vector3d(-20, -20, 50), {31, -20, 48}, {-20, 30, 46}, {30, 31, 52}}) {
        points.push_back({high, {0, 1}});
    }
    points.push_back({{5, 5, 12}, {0, 1}});
    const Scene scene = make_scene({{4, 5, 100}, {60, 4, 90}}, points);
    const TetMesh mesh = triangulate(scene);
    const Labels labels = carve(mesh, crossings_of(mesh, scene), 1);
    const double short_edge = short_edge_length(mesh);
    int free_but_far = 0;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (mesh.cells[cell].is_infinite() || labels[cell] == Label::inside) continue;
        free_but_far += clearance(mesh, mesh.cells[cell]) > 8.0 * short_edge ? 1 : 0;
    }
    EXPECT_GT(free_but_far, 10);
    const VirtualRays rays = virtual_rays_of(scene, mesh, labels, 10000);
    EXPECT_GT(rays.centers.size(), 10U);
    for (const Vector3d& center : rays.centers) {
        const auto cell = std::ranges::find_if(
            mesh.cells, [&](const Cell& candidate) { return holds(mesh, candidate, center); });
        ASSERT_NE(cell, mesh.cells.end());
        EXPECT_GE(clearance(mesh, *cell), 0.5 * short_edge);
        EXPECT_LE(clearance(mesh, *cell), 8.0 * short_edge);
    }
}

TEST_F(VirtualViews, SeesNothingThroughCellsBehindSeenPoints)
{
    const Scene scene = paper_object("boissonnat");
    const TetMesh mesh = triangulate(scene);
    // With all views the labels are correct, and few solid cells lack evidence.
    const Labels labels = carve(mesh, crossings_of(mesh, scene), 1);
    std::set<Index> solid;
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            const Vector3d& point = mesh.positions[vertex];
            const Vector3d inward = 1e-6 * (point - scene.views[view].center);
            for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
                const auto& corners = mesh.cells[cell].vertices;
                if (std::ranges::count(corners, vertex) > 0 && labels[cell] == Label::inside &&
                    holds(mesh, mesh.cells[cell], point + inward)) {
                    solid.insert(cell);
                }
            }
        }
    }
    const VirtualRays rays = virtual_rays_of(scene, mesh, labels, 10);
    ASSERT_GT(rays.tracks.views.size(), 100U);
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        for (const std::uint32_t view : rays.tracks[vertex]) {
            const Vector3d& center = rays.centers[view];
            for (const auto& [facet, share] : crossings_by_brute_force(mesh, vertex, center)) {
                EXPECT_FALSE(solid.contains(facet.cell));
            }
        }
    }
}

TEST_F(VirtualViews, SeesNoPointThatNoViewSaw)
{
    const Scene scene = seen_by_two(paper_object("desk"), 3, 7);
    const TetMesh mesh = triangulate(scene);
    const Labels labels = carve(mesh, crossings_of(mesh, scene), 1);
    const VirtualRays rays = virtual_rays_of(scene, mesh, labels, 25);
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        EXPECT_TRUE(!scene.tracks[vertex].empty() || rays.tracks[vertex].empty());
    }
}

TEST_F(VirtualViews, PlacesNoViewpointIfNothingIsFree)
{
    const Scene scene = bumpy_sphere(300, 1);
    const TetMesh mesh = triangulate(scene);
    const Labels solid(mesh.cells.size(), Label::inside);
    const VirtualRays rays = virtual_rays_of(scene, mesh, solid, 25);
    EXPECT_TRUE(rays.centers.empty());
    EXPECT_TRUE(rays.tracks.views.empty());
    EXPECT_EQ(rays.tracks.size(), scene.num_points());
}

// ---- weights ------------------------------------------------------------------------------------

/// The scene with the virtual views as its only views.
Scene as_real(Scene scene, const VirtualRays& rays)
{
    scene.views.assign(rays.centers.size(), {});
    for (std::size_t i = 0; i < rays.centers.size(); ++i) {
        scene.views[i].center = rays.centers[i];
    }
    scene.tracks = rays.tracks;
    return scene;
}

TEST_F(VirtualViews, CountsLikeRealViewsAtFullWeight)
{
    const Scene scene = bumpy_sphere(500, 4);
    const TetMesh mesh = triangulate(scene);
    const Crossings before = crossings_of(mesh, scene);
    const VirtualRays rays = virtual_rays_of(scene, mesh, carve(mesh, before, 1), 25);
    const Crossings own = crossings_of(mesh, as_real(scene, rays));
    Crossings whole = before;
    CrossingCounter(mesh).cast(rays.source(1.0), whole, stage_);
    Crossings half = before;
    CrossingCounter(mesh).cast(rays.source(0.5), half, stage_);
    std::uint32_t most = 0;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4; ++slot) {
            most = std::max(most, own[cell][slot]);
            ASSERT_EQ(whole[cell][slot], before[cell][slot] + own[cell][slot]);
            ASSERT_EQ(half[cell][slot], before[cell][slot] + own[cell][slot] / 2);
        }
    }
    EXPECT_GT(most, 3U);
}

TEST_F(VirtualViews, VotesForOutsideLikeRealViewsAtFullWeight)
{
    const Scene scene = bumpy_sphere(500, 4);
    const TetMesh mesh = triangulate(scene);
    const TraceOptions options = {.views_sigma = 0.0};
    const VisibilityEnergy before = energy_of(mesh, scene, options);
    const Labels labels = carve(mesh, crossings_of(mesh, scene), 1);
    const VirtualRays rays = virtual_rays_of(scene, mesh, labels, 25);
    const Scene real = as_real(scene, rays);
    const VisibilityEnergy own = energy_of(mesh, real, options);
    VisibilityEnergy energy = before;
    RayCaster(mesh, scene, measure_scales(mesh, scene), options)
        .cast(rays.source(1.0), energy, stage_);

    // Real rays also vote for the cell behind the point to be inside.
    std::vector<std::int32_t> sinks(mesh.cells.size(), 0);
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        RayWalk walk(mesh, vertex);
        for (const std::uint32_t view : rays.tracks[vertex]) {
            const Index behind = walk.first_cell(2.0 * mesh.positions[vertex] - rays.centers[view]);
            if (behind != kInfinite) sinks[behind] += own.unit;
        }
    }
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        const FlowNetwork& network = energy.network;
        ASSERT_EQ(network.terminal_capacities[cell], before.network.terminal_capacities[cell] +
                                                         own.network.terminal_capacities[cell] +
                                                         sinks[cell]);
        for (int slot = 0; slot < 4; ++slot) {
            ASSERT_EQ(network.arc_capacities[cell][slot],
                      before.network.arc_capacities[cell][slot] +
                          own.network.arc_capacities[cell][slot]);
        }
    }
    EXPECT_EQ(energy.cell_of_view, before.cell_of_view); // virtual views add none
}

} // namespace
} // namespace vcarve::virtual_views_test
