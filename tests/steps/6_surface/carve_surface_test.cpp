#include "mesh/check.h"
#include "page/page_scene.h"
#include "pipeline/scene_run.h"
#include "steps/3_cells/triangulate.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/provenance.h"
#include "support/half_edges.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/tetra_grid.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace vcarve::carve_surface_test {
namespace {

using Eigen::Vector3d;
using testing::volume;

TEST(ExtractSurface, ReturnsFourOutwardFacetsForOneCell)
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

TEST(ExtractSurface, HasNoColorsIfThePointsHaveNone)
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

TEST(ExtractSurface, IsEmptyIfNoCellIsInside)
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

TEST(ViewAgreement, CountsRaysOnTheFrontOfTheirFaces)
{
    const SeenTriangle seen({{0, 0, 5}, {0, 0, -5}, {3, 3, 1}});
    const ViewAgreement agreement = view_agreement(testing::half_edges(seen.mesh), seen.scene);
    EXPECT_EQ(agreement.rays, 9);
    EXPECT_EQ(agreement.facing, 6);
}

TEST(ViewAgreement, IgnoresCornersWithoutAPoint)
{
    SeenTriangle seen({{0, 0, 5}});
    seen.mesh.points[1] = kNoPoint;
    EXPECT_EQ(view_agreement(testing::half_edges(seen.mesh), seen.scene).rays, 2);
}

/// Four disjoint triangles with legs of 1, 2, 3 and 4.
TriMesh four_triangles()
{
    TriMesh mesh;
    mesh.offset = {1, 2, 3};
    for (const double leg : {1.0, 2.0, 3.0, 4.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const Vector3d corner(10 * leg, 0, 0);
        mesh.positions.insert(mesh.positions.end(),
                              {corner, corner + Vector3d(leg, 0, 0), corner + Vector3d(0, leg, 0)});
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(Removals, KeepTheFirstReasonOfEachFace)
{
    RemovedFaces removed;
    Removals removals(&removed);
    removals.note({1, 0, 1, 1}, Removal::unseen);
    removals.note({1, 0, 1, 0}, Removal::closing);
    removals.add_noted(four_triangles());
    EXPECT_EQ(removed.reasons, (std::vector{Removal::unseen, Removal::closing}));
    EXPECT_EQ(removed.mesh.faces, (std::vector<Face>{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(removed.mesh.positions,
              (std::vector<Vector3d>{
                  {20, 0, 0}, {22, 0, 0}, {20, 2, 0}, {40, 0, 0}, {44, 0, 0}, {40, 4, 0}}));
    EXPECT_EQ(removed.mesh.offset, Vector3d(1, 2, 3));
}

TEST(Removals, AddFacesDeletedBeforeHolesWereFilled)
{
    HalfEdgeMesh mesh = testing::half_edges(four_triangles());
    for (const int face : {1, 3}) {
        mesh.status(OpenMesh::FaceHandle(face)).set_deleted(true);
    }
    RemovedFaces removed;
    Removals(&removed).add_deleted(mesh, 3);
    EXPECT_EQ(removed.reasons, std::vector{Removal::small_piece});
    ASSERT_EQ(removed.mesh.faces, (std::vector<Face>{{0, 1, 2}}));
    EXPECT_EQ(removed.mesh.positions[1], Vector3d(22, 0, 0));
}

TEST(Removals, DoNothingWithoutARecipient)
{
    Removals removals(nullptr);
    removals.note({0, 0}, Removal::unseen);
    removals.add_noted(four_triangles());
}

/// Records the counts of the stages of a run.
struct StageCounts : Log {
    void stage_ends(std::string_view name, const Counts& counts) override
    {
        for (const Count& count : counts) {
            all[std::string(name) + " " + count.name()] = count.value;
        }
    }
    std::map<std::string, std::int64_t> all;
};

std::int64_t count(const RemovedFaces& removed, Removal reason)
{
    return std::ranges::count(removed.reasons, reason);
}

/// Adds a bumpy sphere below the scene's sphere, and its views. It is smaller than the minimum
/// component.
void add_crumb(Scene& scene)
{
    const Scene crumb =
        moved(bumpy_sphere(100, 9), 0.12, Eigen::Quaterniond::Identity(), Vector3d(0, -1.6, -0.4));
    const auto first_view = static_cast<std::uint32_t>(scene.views.size());
    std::ranges::copy(crumb.views, std::back_inserter(scene.views));
    std::ranges::copy(crumb.positions, std::back_inserter(scene.positions));
    std::ranges::copy(crumb.colors, std::back_inserter(scene.colors));
    std::ranges::copy(crumb.errors_px, std::back_inserter(scene.errors_px));
    std::ranges::copy(crumb.point_ids, std::back_inserter(scene.point_ids));
    for (std::size_t point = 0; point < crumb.num_points(); ++point) {
        std::vector<std::uint32_t> track;
        for (const std::uint32_t view : crumb.tracks[point]) {
            track.push_back(first_view + view);
        }
        scene.tracks.push_back(track);
    }
}

const RunImages kNone; ///< a run without photographs

std::pair<TriMesh, RemovedFaces> mesh_and_removed(const Scene& scene, const SceneRun& run)
{
    ReportedRun made = reconstruct_thinned(scene, size_of(scene), run);
    return {std::move(made.mesh), std::move(made.removed)};
}

TEST(RemovedFaces, MatchTheCountsOfTheStages)
{
    Scene scene = bumpy_sphere(2000, 8);
    add_crumb(scene);
    Options options;
    options.surface.cleanup.max_hole = 0;
    options.surface.cleanup.min_component = 600; // half for closed components
    options.surface.rules.max_closing = 0.05;
    options.crop.region.kind = RegionChoice::Kind::box;
    options.crop.region.low = Vector3d(-2, -2, -0.9);
    options.crop.region.high = Vector3d(2, 2, 0.2);
    // No view saw one side of the sphere.
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        if (scene.positions[point].x() > 0.6) scene.errors_px[point] = 100.0;
    }
    StageCounts log;
    SceneRun run = {.options = options, .images = kNone, .log = log, .wants_report = true};
    const auto [mesh, removed] = mesh_and_removed(scene, run);
    EXPECT_EQ(count(removed, Removal::unseen), log.all["surface unseen"]);
    EXPECT_EQ(count(removed, Removal::closing), log.all["surface unsupported"]);
    EXPECT_EQ(count(removed, Removal::outside_region), log.all["surface outside the region"]);
    EXPECT_EQ(count(removed, Removal::small_piece),
              log.all["surface faces"] - static_cast<std::int64_t>(mesh.faces.size()));
    for (const Removal reason : {Removal::unseen, Removal::outside_region, Removal::small_piece}) {
        EXPECT_GT(count(removed, reason), 0) << kRemovalNames[static_cast<std::size_t>(reason)];
    }
    EXPECT_EQ(removed.mesh.faces.size(), removed.reasons.size());

    run.wants_report = false;
    const TriMesh same = mesh_and_removed(scene, run).first;
    EXPECT_EQ(same.faces, mesh.faces);
    EXPECT_EQ(same.positions, mesh.positions);
}

TEST(RemovedFaces, DistinguishUnsupportedFromUnseenFaces)
{
    StageCounts log;
    const Scene scene = read_model(fixtures_folder() / "room", log);
    const Options options;
    const auto [mesh, removed] = mesh_and_removed(
        scene, {.options = options, .images = kNone, .log = log, .wants_report = true});
    EXPECT_GT(count(removed, Removal::closing), 0);
    EXPECT_EQ(count(removed, Removal::closing), log.all["surface unsupported"]);
    EXPECT_EQ(count(removed, Removal::unseen), log.all["surface unseen"]);
}

TEST(PackedRemoved, HoldsTheLargestFacesAndCountsAll)
{
    RemovedFaces removed;
    removed.mesh = four_triangles();
    removed.reasons = {Removal::small_piece, Removal::unseen, Removal::small_piece,
                       Removal::unseen};
    const auto json = packed_removed(removed, {.removed = 2});
    EXPECT_EQ(json["of"], 4);
    EXPECT_EQ(json["faces"]["count"], 2);
    EXPECT_EQ(json["positions"]["count"], 6);
    EXPECT_EQ(json["why"], "AwA="); // 3 and 0
    const auto expected = nlohmann::ordered_json::parse(
        R"([{"reason": 0, "name": "unseen", "of": 2},
            {"reason": 3, "name": "small pieces", "of": 2}])");
    EXPECT_EQ(json["reasons"], expected);
    EXPECT_EQ(packed_removed(removed)["faces"]["count"], 4);
    EXPECT_EQ(packed_removed({})["of"], 0);
}

} // namespace
} // namespace vcarve::carve_surface_test
