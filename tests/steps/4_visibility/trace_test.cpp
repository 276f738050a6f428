#include "base/numbers.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/walk.h"
#include "steps/5_labels/label_cells.h"
#include "support/cast_rays.h"
#include "support/exact_ray.h"
#include "support/paper_rule.h"
#include "support/point_sets.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/unpushed_network.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vcarve::trace_test {
namespace {

using Eigen::Vector3d;
using Four = std::array<std::int32_t, 4>;

VisibilityEnergy traced(const TetMesh& mesh, const Scene& scene, const TraceOptions& options)
{
    Log log;
    Stage stage(log, "rays");
    return energy_of(mesh, scene, options);
}

Crossings counted(const TetMesh& mesh, const Scene& scene)
{
    Log log;
    Stage stage(log, "rays");
    return crossings_of(mesh, scene);
}

template <typename Action>
auto with_threads(int threads, const Action& action)
{
    tbb::task_arena arena(threads);
    return arena.execute(action);
}

void expect_equal(const VisibilityEnergy& a, const VisibilityEnergy& b)
{
    EXPECT_EQ(a.network.arc_capacities, b.network.arc_capacities);
    EXPECT_EQ(a.network.terminal_capacities, b.network.terminal_capacities);
    EXPECT_EQ(a.cell_of_view, b.cell_of_view);
    EXPECT_EQ(a.unit, b.unit);
}

/// A tetrahedron around the origin, which is point 4. Finite cells: 0 {0 1 2 4}, 2 {0 1 3 4},
/// 4 {0 2 3 4}, 6 {1 2 3 4}. The infinite cell beyond each has the next number. Slot 3 of a finite
/// cell is its facet on the hull, and slot 3 of the infinite cell the same facet. One view at each
/// center sees the origin only.
Scene star(const Positions& centers)
{
    std::vector<std::uint32_t> all;
    for (std::uint32_t view = 0; view < centers.size(); ++view) {
        all.push_back(view);
    }
    return make_scene(centers, {{{4, 4, 4}, {}},
                                {{-4, -4, 4}, {}},
                                {{-4, 4, -4}, {}},
                                {{4, -4, -4}, {}},
                                {{0, 0, 0}, all}});
}

const Vector3d kBeyondCell0(0, 8, 16); // the ray to it leaves the hull at a sixth
const Vector3d kInCell0(0, 1, 2);

constexpr TraceOptions kFullWeight = {.views_sigma = 0.0, .distance_sigma = 0.0, .sink_depth = 0.0};

ArcCapacities no_arc_capacities()
{
    return {8, Four{0, 0, 0, 0}};
}

// ---- bundles of rays ----------------------------------------------------------------------------

/// A dense cloud of points in a long tube. Views beyond its end see the first ten.
Scene tube()
{
    std::vector<MadePoint> points;
    for (std::uint64_t i = 0; i < 500; ++i) {
        const double x = i < 10 ? random_number(1, 3 * i) : 40.0 * random_number(1, 3 * i);
        points.push_back({{x, random_number(1, 3 * i + 1), random_number(1, 3 * i + 2)}, {}});
        if (i < 10) points.back().views = {0, 1, 2};
    }
    Scene scene = make_scene({{50, 0.4, 0.4}, {50, 0.5, 0.6}, {50, 0.6, 0.5}}, points);
    scene.is_dense = true;
    return scene;
}

/// The energy of rays that are walked one by one and bundled as in the header: one in four rays
/// continues after 16 facets, and one in 16 after 40.
struct BundledByHand {
    ArcCapacities arcs;
    UnsetArray<std::int32_t> terminals;
    int gone_on = 0; ///< rays that continue for 16

    BundledByHand(const TetMesh& mesh, const Scene& scene)
        : arcs(mesh.cells.size(), Four{0, 0, 0, 0}), terminals(mesh.cells.size(), 0)
    {
        for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
            for (const std::uint32_t view : scene.tracks[vertex]) {
                add(mesh, vertex, view, scene.views[view].center);
            }
        }
    }

    void add(const TetMesh& mesh, Index vertex, std::uint32_t view, const Vector3d& center)
    {
        int crossed = 0;
        std::int32_t carried = 0;
        RayWalk walk(mesh, vertex);
        walk.to(center, [&](Index cell, int slot) {
            ++crossed;
            const std::uint32_t lead = crossed <= 16 ? 1 : crossed <= 40 ? 4 : 16;
            if ((vertex + view) % lead != 0) return;
            const auto weight = static_cast<std::int32_t>(lead * 256);
            arcs[cell][slot] += weight;
            terminals[cell] += weight - carried;
            carried = weight;
        });
        gone_on += carried == 16 * 256 ? 1 : 0;
        const Index behind = walk.first_cell(2.0 * mesh.positions[vertex] - center);
        if (behind != kInfinite) terminals[behind] -= 256;
    }
};

TEST(TraceRays, ContinuesOneRayPerBundleInDenseClouds)
{
    const Scene scene = tube();
    const TetMesh mesh = triangulate(scene);
    TraceOptions options = kFullWeight;
    options.bundle_rays = 4;
    const VisibilityEnergy energy = traced(mesh, scene, options);
    const BundledByHand expected(mesh, scene);
    ASSERT_GT(expected.gone_on, 0);
    EXPECT_EQ(energy.network.arc_capacities, expected.arcs);
    EXPECT_EQ(energy.network.terminal_capacities, expected.terminals);
    options.bundle_rays = 1;
    EXPECT_EQ(energy.cell_of_view, traced(mesh, scene, options).cell_of_view);
}

TEST(TraceRays, ContinuesOneRayPerBundleThroughEdgesAndVertices)
{
    // A beam of lattice points. Rays from its first square run through edges and vertices, so the
    // exact walk takes over.
    std::vector<MadePoint> points;
    for (int i = 0; i < 60 * 3 * 3; ++i) {
        const Vector3d place(i / 9, i / 3 % 3, i % 3);
        points.push_back({place, {}});
        if (place.x() == 0.0) points.back().views = {0, 1, 2};
    }
    Scene scene = make_scene({{118, 3, 2}, {118, 1, 0.5}, {118, 2, 1.5}}, points);
    scene.is_dense = true;
    const TetMesh mesh = triangulate(scene);
    TraceOptions options = kFullWeight;
    options.bundle_rays = 4;
    const BundledByHand expected(mesh, scene);
    ASSERT_GT(expected.gone_on, 0);
    EXPECT_EQ(traced(mesh, scene, options).network.arc_capacities, expected.arcs);
}

TEST(TraceRays, DoesNotBundleRaysOfSparseModels)
{
    Scene scene = tube();
    scene.is_dense = false;
    const TetMesh mesh = triangulate(scene);
    TraceOptions options = kFullWeight;
    options.bundle_rays = 4;
    const VisibilityEnergy bundled = traced(mesh, scene, options);
    options.bundle_rays = 1;
    expect_equal(bundled, traced(mesh, scene, options));
}

// ---- hand-computed cases ------------------------------------------------------------------------

TEST(CountCrossings, CountsBothSidesOfAFacet)
{
    const Scene scene = star({kBeyondCell0, kInCell0, 2.0 * kBeyondCell0});
    const Crossings crossings = counted(triangulate(scene), scene);
    Crossings expected(8, {0, 0, 0, 0});
    expected[0][3] = 2;
    expected[1][3] = 2;
    EXPECT_EQ(crossings, expected);
}

TEST(TraceRays, PushesTheFlowOfARayFromOutsideTheHull)
{
    const Scene scene = star({kBeyondCell0});
    const VisibilityEnergy energy = traced(triangulate(scene), scene, kFullWeight);
    ArcCapacities arc_capacities = no_arc_capacities();
    arc_capacities[0][3] = 256; // outwards; the inward arc is saturated
    EXPECT_EQ(energy.network.arc_capacities, arc_capacities);
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{256, 0, 0, 0, 0, 0, -256, 0}));
    EXPECT_EQ(energy.cell_of_view, std::vector<Index>{kInfinite});
    EXPECT_EQ(energy.unit, 256);
}

TEST(TraceRays, LeavesAllFlowInTheCellOfTheViewIfTheRayCrossesNoFacet)
{
    const Scene scene = star({kInCell0});
    const VisibilityEnergy energy = traced(triangulate(scene), scene, kFullWeight);
    EXPECT_EQ(energy.network.arc_capacities, no_arc_capacities());
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{256, 0, 0, 0, 0, 0, -256, 0}));
    EXPECT_EQ(energy.cell_of_view, std::vector<Index>{0});
}

TEST(TraceRays, FindsTheCellsOfViewsWithoutPoints)
{
    Scene scene = star({kBeyondCell0});
    for (const Vector3d& center : {kInCell0, kBeyondCell0}) {
        scene.views.push_back(scene.views[0]);
        scene.views.back().center = center;
    }
    const VisibilityEnergy energy = traced(triangulate(scene), scene, kFullWeight);
    EXPECT_EQ(energy.cell_of_view, (std::vector<Index>{kInfinite, 0, kInfinite}));
}

TEST(TraceRays, WeightsARayByTheViewsOfItsPointRelativeToTheMedian)
{
    // The origin has one view. Point 0 has two, outside the hull, and cell 4 is behind it.
    Scene scene = star({kBeyondCell0});
    scene = make_scene({kBeyondCell0, {8, 8, 9}, {12, 12, 14}}, {{scene.positions[0], {1, 2}},
                                                                 {scene.positions[1], {}},
                                                                 {scene.positions[2], {}},
                                                                 {scene.positions[3], {}},
                                                                 {scene.positions[4], {0}}});
    const TraceOptions options = {.views_sigma = 3.0, .distance_sigma = 0.0, .sink_depth = 0.0};
    const VisibilityEnergy energy = traced(triangulate(scene), scene, options);
    // 256 (1 - exp(-1 / 18)) / (1 - exp(-4 / 18)) = 69.4, relative to 256
    ArcCapacities arc_capacities = no_arc_capacities();
    arc_capacities[0][3] = 69;
    EXPECT_EQ(energy.network.arc_capacities, arc_capacities);
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{69, 0, 0, 0, -512, 0, -69, 0}));
}

TEST(TraceRays, WeightsARayLessForAnErrorAboveTheMedian)
{
    Scene scene = star({kBeyondCell0});
    scene.errors_px = {1.0, 1.0, 1.0, -1.0, 2.0}; // that of the origin is twice the median
    TraceOptions options = kFullWeight;
    options.error_sigma = 3.0;
    const std::int32_t weight = 217; // 256 exp(-(4 - 1) / 18)
    EXPECT_EQ(traced(triangulate(scene), scene, options).network.terminal_capacities,
              (UnsetArray<std::int32_t>{weight, 0, 0, 0, 0, 0, -weight, 0}));

    const UnsetArray<std::int32_t> full = {256, 0, 0, 0, 0, 0, -256, 0};
    for (const double harmless_px : {0.0, 1.0, -1.0}) {
        scene.errors_px[4] = harmless_px;
        EXPECT_EQ(traced(triangulate(scene), scene, options).network.terminal_capacities, full);
    }
    scene.errors_px[4] = 2.0;
    options.error_sigma = 0.0;
    EXPECT_EQ(traced(triangulate(scene), scene, options).network.terminal_capacities, full);
    options.error_sigma = 3.0;
    scene.errors_px.assign(5, -1.0);
    EXPECT_EQ(traced(triangulate(scene), scene, options).network.terminal_capacities, full);
}

TEST(TraceRays, ClampsFullArcsAndRejectsFullCells)
{
    // The weight of one ray exceeds the limit of an arc, which is clamped. The excess of a cell
    // must be exact, so more such rays are rejected.
    const Scene scene = star({kBeyondCell0});
    const TetMesh mesh = triangulate(scene);
    RaySource heavy = photographs(scene);
    heavy.weight = 2.2e6;
    const auto cast = [&](VisibilityEnergy& energy) {
        Log silent;
        Stage stage(silent, "rays");
        RayCaster(mesh, scene, measure_scales(mesh, scene), kFullWeight).cast(heavy, energy, stage);
    };
    VisibilityEnergy energy;
    cast(energy);
    EXPECT_EQ(energy.network.arc_capacities[0][3], 1 << 29);
    EXPECT_EQ(energy.network.terminal_capacities[0], 563'200'000);
    EXPECT_EQ(refusal<InputError>([&] {
                  cast(energy);
                  cast(energy);
              }),
              "the weights of the 1 rays of the model exceed 32 bits in one cell; use fewer "
              "points or views");
}

TEST(TraceRays, CountWitnessesForThePointsThatTheyStandFor)
{
    Scene scene = star({kBeyondCell0});
    const TetMesh mesh = triangulate(scene);
    const auto cast = [&](double points) {
        VisibilityEnergy energy;
        Scales scales = measure_scales(mesh, scene);
        scales.points_of_witness = points;
        RayCaster(mesh, scene, scales, kFullWeight).cast(photographs(scene), energy, {});
        return energy.network;
    };
    const FlowNetwork measured = cast(3.0);
    scene.kinds.assign(scene.num_points(), PointKind::witness);
    const FlowNetwork once = cast(1.0);
    EXPECT_EQ(once.arc_capacities, measured.arc_capacities);
    const FlowNetwork thrice = cast(3.0);
    EXPECT_GT(once.arc_capacities[0][3], 0);
    EXPECT_EQ(thrice.arc_capacities[0][3], 3 * once.arc_capacities[0][3]);
    EXPECT_EQ(thrice.terminal_capacities[0], 3 * once.terminal_capacities[0]);
}

TEST(TraceRays, AddsNothingWithoutRays)
{
    const Scene scene = star({});
    const VisibilityEnergy energy = traced(triangulate(scene), scene, {});
    EXPECT_EQ(energy.network.arc_capacities, no_arc_capacities());
    EXPECT_EQ(energy.network.terminal_capacities, UnsetArray<std::int32_t>(8, 0));
}

TEST(TraceRays, ReducesWeightsNearThePoint)
{
    // The distance to the facet is |(0, 4/3, 8/3)| = 2.98142. Four of the ten edges have length
    // sqrt(48) = 6.9282 and six sqrt(128), so a short edge is 6.9282.
    const Scene scene = star({kBeyondCell0});
    const TraceOptions options = {.views_sigma = 0.0, .distance_sigma = 0.5, .sink_depth = 0.0};
    const VisibilityEnergy energy = traced(triangulate(scene), scene, options);
    ArcCapacities arc_capacities = no_arc_capacities();
    arc_capacities[0][3] = 79; // 256 (1 - exp(-(2.98142 / 3.4641)^2 / 2)) = 79.24
    EXPECT_EQ(energy.network.arc_capacities, arc_capacities);
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{79, 0, 0, 0, 0, 0, -256, 0}));
}

TEST(TraceRays, AddsNoInsideVoteBehindABorderPoint)
{
    Scene scene = star({kBeyondCell0});
    scene.kinds.assign(scene.num_points(), PointKind::measured);
    scene.kinds[4] = PointKind::border;
    const VisibilityEnergy energy = traced(triangulate(scene), scene, kFullWeight);
    ArcCapacities arc_capacities = no_arc_capacities();
    arc_capacities[0][3] = 256;
    EXPECT_EQ(energy.network.arc_capacities, arc_capacities);
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{256, 0, 0, 0, 0, 0, 0, 0}));
    scene.kinds[4] = PointKind::crease;
    EXPECT_EQ(traced(triangulate(scene), scene, kFullWeight).network.terminal_capacities,
              (UnsetArray<std::int32_t>{256, 0, 0, 0, 0, 0, -256, 0}));
}

TEST(TraceRays, AddsNoInsideVoteBehindAHullPoint)
{
    Scene scene = make_scene(
        {{1, 1, 1}},
        {{{0, 0, 0}, {}}, {{4, 0, 0}, {}}, {{0, 4, 0}, {}}, {{1, 1, 3}, {0}}, {{1, 1, -3}, {0}}});
    const VisibilityEnergy energy = traced(triangulate(scene), scene, kFullWeight);
    // Cell 0 {0 1 2 3} contains the view. The ray of point 4 enters it from cell 1 {0 1 2 4}.
    ArcCapacities arc_capacities = no_arc_capacities();
    arc_capacities[1][3] = 256;
    EXPECT_EQ(energy.network.arc_capacities, arc_capacities);
    EXPECT_EQ(energy.network.terminal_capacities,
              (UnsetArray<std::int32_t>{256, 256, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(energy.cell_of_view, std::vector<Index>{0});
}

// ---- against brute force ------------------------------------------------------------------------

/// Views inside and outside the hull.
Positions centers_around(std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    Positions centers;
    for (int view = 0; view < 6; ++view) {
        centers.push_back(
            even_in_cube(random, view % 2 == 0 ? 0.1 : -1.5, view % 2 == 0 ? 0.9 : 2.5));
    }
    return centers;
}

Crossings crossings_of_all_rays(const TetMesh& mesh, const Scene& scene)
{
    Crossings crossings(mesh.cells.size(), {0, 0, 0, 0});
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            const Vector3d& center = scene.views[view].center;
            for (const auto& [facet, share] : crossings_by_brute_force(mesh, vertex, center)) {
                ++crossings[facet.cell][facet.slot];
                const Index beyond = mesh.cells[facet.cell].neighbors[facet.slot];
                ++crossings[beyond][mesh.mirror(facet.cell, facet.slot)];
            }
        }
    }
    return crossings;
}

TEST(CountCrossings, MatchesBruteForce)
{
    for (const NamedCells& named : meshes_to_walk()) {
        std::mt19937_64 random(41);
        Positions centers;
        for (int view = 0; view < 6; ++view) {
            centers.push_back(any_target(named, static_cast<Index>(view), random));
        }
        const Scene scene = scene_seen_from(centers, named.mesh.positions, 0.5, 42);
        EXPECT_EQ(counted(named.mesh, scene), crossings_of_all_rays(named.mesh, scene))
            << named.name;
    }
}

TEST(CountCrossings, MatchesTheRuleOfThePaper)
{
    const Scene scene = scene_seen_from(centers_around(43), random_points(90, 44), 0.4, 45);
    const TetMesh mesh = triangulate(scene);
    const auto marks = marks_by_paper_rule(mesh, scene);
    const Crossings crossings = counted(mesh, scene);
    std::array<int, 3> found = {0, 0, 0};
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && !mesh.cells[cell].is_infinite(); ++slot) {
            const Mark mark = marks[cell][slot];
            ++found[static_cast<std::size_t>(mark)];
            if (mark != Mark::unclear) {
                ASSERT_EQ(crossings[cell][slot] > 0, mark == Mark::redundant)
                    << "cell " << cell << ", slot " << slot;
            }
        }
    }
    EXPECT_EQ(found, (std::array<int, 3>{694, 14, 1016})); // none, unclear, redundant
}

/// Compares the cut of the pushed network with Boost's cut of the unpushed network. Returns the
/// number of inside cells.
std::ptrdiff_t compare_cuts(const Scene& scene, const TraceOptions& options)
{
    const TetMesh mesh = triangulate(scene);
    const VisibilityEnergy energy = traced(mesh, scene, options);
    UnpushedNetwork network = network_of_rays(mesh, scene, options);
    pin_outside(mesh, energy.cell_of_view, network);
    const Labels expected = boost_minimum_cut(mesh, network);
    const Labels labels = cut(mesh, energy, {.quality = 0.0});
    EXPECT_TRUE(labels == expected)
        << "distance_sigma " << options.distance_sigma << ", sink depth " << options.sink_depth;
    return std::count(expected.begin(), expected.end(), Label::inside);
}

const std::array<TraceOptions, 7> kTraceOptions = {{{0.0, 0.0, 0.0},
                                                    {3.0, 0.0, 0.0},
                                                    {3.0, 0.5, 0.0},
                                                    {3.0, 2.0, 0.0},
                                                    {3.0, 1.0, 1.0},
                                                    {0.0, 0.5, 3.0},
                                                    {3.0, 4.0, 0.5}}};

TEST(TraceRays, DoesNotChangeTheMinimumCut)
{
    std::ptrdiff_t inside = 0;
    for (const TraceOptions& options : kTraceOptions) {
        for (std::uint64_t seed = 50; seed < 56; ++seed) {
            inside += compare_cuts(
                scene_seen_from(centers_around(seed), random_points(70, seed), 0.35, seed),
                options);
        }
    }
    EXPECT_EQ(inside, 1938);
}

TEST(TraceRays, DoesNotChangeTheMinimumCutForRaysThroughEdgesAndVertices)
{
    // Views on points, edges and facets, in cells, and outside the hull.
    const Positions centers = {{1, 1, 1},   {1.5, 1.5, 1.5},    {2, 1.5, 1}, {2, 2, 3},
                               {1.5, 0, 4}, {0.5, 2.25, 1.375}, {6, 5, 4},   {1, 7, 2}};
    std::ptrdiff_t inside = 0;
    for (const TraceOptions& options : kTraceOptions) {
        for (std::uint64_t seed = 60; seed < 64; ++seed) {
            inside += compare_cuts(scene_seen_from(centers, lattice(5), 0.3, seed), options);
        }
    }
    EXPECT_EQ(inside, 720);
}

TEST(TraceRays, FindsTheLowestCellOfAViewOnABoundary)
{
    const Positions centers = {{1, 1, 1}, {1.5, 1.5, 1.5}, {2, 1.5, 1}, {5, 4, 1}, {1.5, 0, 4}};
    const Scene scene = scene_seen_from(centers, lattice(4), 0.5, 62);
    const TetMesh mesh = triangulate(scene);
    std::vector<Index> expected(centers.size(), kInfinite); // for the last two views, too
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            RayWalk walk(mesh, vertex);
            const Index last = walk.to(centers[view], [](Index, int) {}).last;
            if (last != kInfinite && !mesh.cells[last].is_infinite()) {
                expected[view] = std::min(expected[view], last);
            }
        }
    }
    EXPECT_EQ(traced(mesh, scene, kFullWeight).cell_of_view, expected);
}

TEST(TraceRays, DoesNotDependOnTheThreadCount)
{
    const Positions views_on_points = {{1, 1, 1}, {2, 2, 2.5}, {3.5, 3.5, 3.5}, {9, 20, 30}};
    for (const Scene& scene :
         {bumpy_sphere(3000, 71), scene_seen_from(views_on_points, lattice(12), 0.7, 72)}) {
        const TetMesh mesh = triangulate(scene);
        const TraceOptions options = {.views_sigma = 3.0, .distance_sigma = 0.5, .sink_depth = 1.0};
        for (int round = 0; round < 3; ++round) {
            expect_equal(with_threads(2, [&] { return traced(mesh, scene, options); }),
                         with_threads(1, [&] { return traced(mesh, scene, options); }));
            EXPECT_EQ(with_threads(2, [&] { return counted(mesh, scene); }),
                      with_threads(1, [&] { return counted(mesh, scene); }));
        }
    }
}

void expect_same_for_views_in_another_order(const Scene& scene)
{
    const std::vector<std::uint32_t> order = {3, 5, 0, 1, 4, 2};
    Scene permuted = scene;
    permuted.tracks = {};
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        std::vector<std::uint32_t> track;
        for (const std::uint32_t view : scene.tracks[vertex]) {
            track.push_back(order[view]);
        }
        std::sort(track.begin(), track.end());
        permuted.tracks.push_back(track);
    }
    for (std::size_t view = 0; view < order.size(); ++view) {
        permuted.views[order[view]] = scene.views[view];
    }
    const TetMesh mesh = triangulate(scene);
    const TraceOptions options = {.views_sigma = 3.0, .distance_sigma = 0.5, .sink_depth = 1.0};
    const VisibilityEnergy energy = traced(mesh, scene, options);
    const VisibilityEnergy again = traced(mesh, permuted, options);
    EXPECT_EQ(again.network.arc_capacities, energy.network.arc_capacities);
    EXPECT_EQ(again.network.terminal_capacities, energy.network.terminal_capacities);
    for (std::size_t view = 0; view < order.size(); ++view) {
        EXPECT_EQ(again.cell_of_view[order[view]], energy.cell_of_view[view]);
    }
    EXPECT_EQ(counted(mesh, permuted), counted(mesh, scene));
}

TEST(TraceRays, DoesNotDependOnTheOrderOfViews)
{
    expect_same_for_views_in_another_order(
        scene_seen_from(centers_around(73), random_points(200, 74), 0.5, 75));
    const Positions on_lattice = {{1, 1, 1}, {1.5, 1.5, 1.5}, {2, 1.5, 1},
                                  {2, 2, 3}, {1.5, 0, 4},     {0.5, 2.25, 1.25}};
    expect_same_for_views_in_another_order(scene_seen_from(on_lattice, lattice(5), 0.7, 76));
}

} // namespace
} // namespace vcarve::trace_test
