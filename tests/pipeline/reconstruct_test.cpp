#include "io/colmap/colmap_model.h"
#include "io/formats/mesh_file.h"
#include "mesh/check.h"
#include "steps/6_surface/provenance.h"
#include "support/half_edges.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace vcarve::reconstruct_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kPoints = 2000;

Reconstruction run(const Scene& scene, const Options& options = {})
{
    Log silent;
    return reconstruct(scene, options, silent);
}

/// The faces as sets of COLMAP point ids in cyclic order, the smallest id first.
std::set<std::array<std::uint64_t, 3>> faces_by_id(const Reconstruction& result)
{
    std::set<std::array<std::uint64_t, 3>> faces;
    for (const Face& face : result.mesh.faces) {
        std::array<std::uint64_t, 3> ids{};
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t point = result.mesh.points[face[i]];
            ids[i] = point == kNoPoint ? 0 : result.scene.point_ids[point];
        }
        std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
        faces.insert(ids);
    }
    return faces;
}

void expect_same_mesh(const TriMesh& a, const TriMesh& b)
{
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.offset, b.offset);
}

TEST(Reconstruct, MakesAManifoldColoredSurfaceThatFacesItsViews)
{
    const Reconstruction result = run(bumpy_sphere(kPoints, 1));
    const MeshCheck check = check_mesh(result.mesh);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.unreferenced_vertices, 0);
    EXPECT_EQ(check.degenerate_faces, 0);
    EXPECT_EQ(result.mesh.colors.size(), result.mesh.positions.size());
    const ViewAgreement agreement = view_agreement(testing::half_edges(result.mesh), result.scene);
    EXPECT_GT(agreement.facing, 0.95 * static_cast<double>(agreement.rays));
    // A sphere has about twice as many faces as vertices, and most points lie on it.
    EXPECT_GT(check.faces, static_cast<std::int64_t>(1.6 * kPoints));
}

TEST(Reconstruct, MakesTheSameMeshForAnyThreadCount)
{
    const Scene scene = bumpy_sphere(kPoints, 2);
    for (const Method method : {Method::cut, Method::strict}) {
        Options one;
        one.labels.method = method;
        one.threads = 1;
        Options two = one;
        two.threads = 2;
        expect_same_mesh(run(scene, one).mesh, run(scene, two).mesh);
    }
}

TEST(Reconstruct, MakesTheSameMeshWithVirtualViewsForAnyThreadCountAndOrder)
{
    const Scene scene = bumpy_sphere(kPoints, 2);
    for (const Method method : {Method::cut, Method::strict}) {
        Options one;
        one.labels.method = method;
        const TriMesh without = run(scene, one).mesh;
        one.labels.virtual_views.count = 40;
        one.threads = 1;
        Options two = one;
        two.threads = 2;
        const TriMesh mesh = run(scene, one).mesh;
        expect_same_mesh(mesh, run(permuted(scene, 3), two).mesh);
        EXPECT_NE(mesh.faces, without.faces);
    }
}

TEST(Reconstruct, MakesTheSameMeshForAnyOrderOfPointsAndViews)
{
    const Scene scene = bumpy_sphere(kPoints, 3);
    expect_same_mesh(run(scene).mesh, run(permuted(scene, 7)).mesh);
}

TEST(Reconstruct, ScalesExactlyByPowersOfTwo)
{
    const Scene scene = bumpy_sphere(kPoints, 4);
    const Reconstruction original = run(scene);
    for (const double scale : {1.0 / 1024.0, 4096.0}) {
        const Reconstruction scaled =
            run(moved(scene, scale, Quaterniond::Identity(), Vector3d::Zero()));
        EXPECT_EQ(scaled.mesh.faces, original.mesh.faces);
        ASSERT_EQ(scaled.mesh.positions.size(), original.mesh.positions.size());
        for (std::size_t i = 0; i < scaled.mesh.positions.size(); ++i) {
            ASSERT_EQ(scaled.mesh.positions[i], scale * original.mesh.positions[i]);
        }
    }
}

TEST(Reconstruct, MakesTheSameFacesAfterScalingRotationAndTranslation)
{
    const Scene scene = bumpy_sphere(kPoints, 5);
    const auto faces = faces_by_id(run(scene));
    const Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
    const Quaterniond none = Quaterniond::Identity();
    const Vector3d utm(5e5, 4.6e6, 120.0);
    EXPECT_EQ(faces_by_id(run(moved(scene, 1e-3, none, Vector3d::Zero()))), faces);
    EXPECT_EQ(faces_by_id(run(moved(scene, 1e6, none, Vector3d::Zero()))), faces);
    EXPECT_EQ(faces_by_id(run(moved(scene, 1.0, turn, Vector3d::Zero()))), faces);
    EXPECT_EQ(faces_by_id(run(moved(scene, 1.0, none, utm))), faces);
}

/// Expects the same mesh, vertex by vertex, up to the rounding of coordinates far from the origin.
void expect_moved(const TriMesh& far, const TriMesh& near, double scale, const Vector3d& shift)
{
    ASSERT_EQ(far.faces, near.faces);
    ASSERT_EQ(far.points, near.points);
    EXPECT_EQ(far.colors, near.colors);
    const double rounding = shift.cwiseAbs().maxCoeff() * std::numeric_limits<double>::epsilon();
    for (std::size_t v = 0; v < near.positions.size(); ++v) {
        const Vector3d moved = scale * (near.positions[v] + near.offset) + shift;
        ASSERT_LE((far.positions[v] + far.offset - moved).cwiseAbs().maxCoeff(), rounding);
    }
}

TEST(Reconstruct, MakesTheSameMeshInMapCoordinates)
{
    const Vector3d utm(5e5, 4.6e6, 100.0);
    const double metres = 37.3;
    const Scene fixture =
        read_colmap_model(fixtures_folder() / "scene/sparse/0", ModelFormat::binary);
    for (const Scene& near : {bumpy_sphere(kPoints, 6), fixture}) {
        const Quaterniond none = Quaterniond::Identity();
        const Scene far = moved(near, metres, none, utm);
        const TriMesh mesh = run(far).mesh;
        // The rounded coordinates, moved back near the origin
        const Scene back = moved(moved(far, 1.0, none, -utm), 1.0 / metres, none, Vector3d::Zero());
        expect_moved(mesh, run(back).mesh, metres, utm);

        // Written and read back, without and with an offset
        const TemporaryFolder folder;
        for (const Vector3d& offset : {Vector3d(0, 0, 0), round_offset(far)}) {
            write_mesh(folder / "out.ply", mesh, {.offset = offset});
            const TriMesh copy = read_ply(folder / "out.ply");
            EXPECT_EQ(copy.offset, offset);
            for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                ASSERT_LT(
                    (copy.positions[v] + copy.offset - mesh.positions[v] - mesh.offset).norm(),
                    2e-9);
            }
        }
        EXPECT_LT(rounding_share("out.stl", mesh, {.offset = round_offset(far)}), 1e-6);
        EXPECT_GT(rounding_share("out.stl", mesh, {}), 1e-6);
    }
}

void expect_watertight(const Scene& scene, const Options& options, const std::string& name)
{
    const MeshCheck check = check_mesh(run(scene, options).mesh);
    EXPECT_TRUE(check.is_closed()) << name;
    EXPECT_TRUE(check.is_manifold()) << name;
    EXPECT_EQ(check.orientation_faults, 0) << name;
    EXPECT_EQ(check.degenerate_faces, 0) << name;
}

TEST(Reconstruct, MakesAWatertightManifoldWithClosed)
{
    using std::filesystem::path;
    const path fixtures(fixtures_folder());
    Options options;
    options.surface.closed = true;
    for (const Method method : {Method::cut, Method::strict}) {
        options.labels.method = method;
        for (const char* object : {"boissonnat", "cube_with_cavity", "cubicles", "desk"}) {
            const path model = fixtures / "paper" / object;
            expect_watertight(read_colmap_model(model, ModelFormat::text), options, object);
        }
    }
    options.labels.method = Method::cut;
    const path scene = fixtures / "scene" / "sparse_txt";
    expect_watertight(read_colmap_model(scene, ModelFormat::text), options, "scene");
    expect_watertight(bumpy_sphere(kPoints, 6), options, "sphere");
    options.refine.smooth.iterations = 2;
    options.refine.simplify.faces = 1000;
    expect_watertight(bumpy_sphere(kPoints, 6), options, "smooth and simple sphere");
}

TEST(Reconstruct, SmoothsAndSimplifiesIdenticallyForAnyThreadCount)
{
    const Scene scene = bumpy_sphere(kPoints, 2);
    Options one;
    one.refine.smooth.iterations = 2;
    one.refine.simplify.faces = 2500;
    one.threads = 1;
    Options two = one;
    two.threads = 2;
    const TriMesh mesh = run(scene, one).mesh;
    EXPECT_LE(mesh.faces.size(), 2500U);
    expect_same_mesh(mesh, run(scene, two).mesh);
}

TEST(Reconstruct, RejectsASceneWithTooFewPoints)
{
    const Scene scene = make_scene({{0, 0, 5}, {1, 0, 5}}, {{{0, 0, 0}, {0, 1}}});
    try {
        run(scene);
        FAIL() << "no exception";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "1 point passed the filter; a surface needs at least four that "
                                   "do not lie in one plane");
    }
}

TEST(Reconstruct, NamesTheFilterThatDroppedMostPoints)
{
    const auto refused = [](const auto& change) {
        Scene scene = bumpy_sphere(200, 1);
        Options options;
        change(scene, options);
        return refusal<InputError>([&] { run(scene, options); });
    };
    const std::string begin = "0 points passed the filter; a surface needs at least four that do "
                              "not lie in one plane. ";
    EXPECT_EQ(
        refused([](Scene& /*scene*/, Options& options) { options.points.min_views = 1000; }),
        begin +
            "200 of 200 points were dropped by --min-views 1000; try a smaller value, or --rays "
            "nearest");
    // 23 points have one view or none.
    EXPECT_EQ(
        refused([](Scene& /*scene*/, Options& options) { options.points.min_angle_deg = 180.0; }),
        begin + "177 of 200 points were dropped by --min-angle 180; try a smaller value");
    EXPECT_EQ(refused([](Scene& scene, Options& /*options*/) { scene.errors_px.assign(200, 9.0); }),
              begin + "177 of 200 points were dropped by --max-error 4; try a larger value");
    EXPECT_EQ(refused([](Scene& scene, Options& options) {
                  scene.tracks = {};
                  scene.tracks.begins.assign(201, 0);
                  options.points.min_views = 1;
              }),
              begin + "200 of 200 points were dropped by --min-views 1; try --rays nearest");
}

TEST(Reconstruct, WarnsIfTheCameraHardlyMoved)
{
    class Notes : public Log {
      public:
        void note(std::string_view sentence) override { all.emplace_back(sentence); }
        std::vector<std::string> all;
    };
    Scene scene = bumpy_sphere(400, 1);
    Notes moved;
    reconstruct(scene, {}, moved);
    EXPECT_THAT(moved.all, ::testing::IsEmpty());
    const Eigen::Vector3d tripod(0, 0, 50);
    for (View& view : scene.views) {
        view.center = tripod + 0.2 * view.center;
    }
    Notes still;
    reconstruct(scene, {}, still);
    EXPECT_THAT(still.all, ::testing::Contains(::testing::StartsWith(
                               "the rays of half of the points meet at less than 1.")));
}

TEST(Reconstruct, LogsEveryStageOnce)
{
    class Recorder : public Log {
      public:
        void stage_begins(std::string_view name) override { begun.emplace_back(name); }
        void stage_ends(std::string_view name, const Counts&) override { ended.emplace_back(name); }
        std::vector<std::string> begun;
        std::vector<std::string> ended;
    };
    Recorder log;
    reconstruct(bumpy_sphere(500, 8), {}, log);
    const std::vector<std::string> expected = {"memory", "filter", "fill",    "triangulate",
                                               "rays",   "cut",    "surface", "clean",
                                               "open",   "adjust", "orient"};
    EXPECT_EQ(log.begun, expected);
    EXPECT_EQ(log.ended, expected);

    Recorder twice;
    Options with_virtual_views;
    with_virtual_views.labels.virtual_views.count = 10;
    reconstruct(bumpy_sphere(500, 8), with_virtual_views, twice);
    const std::vector<std::string> labeled_twice = {
        "memory", "filter", "fill",    "triangulate", "rays", "cut",    "viewpoints",
        "rays",   "cut",    "surface", "clean",       "open", "adjust", "orient"};
    EXPECT_EQ(twice.begun, labeled_twice);
    EXPECT_EQ(twice.ended, labeled_twice);
}

/// The number of vertices whose positions differ from their points.
std::int64_t num_moved(const Reconstruction& made)
{
    std::int64_t moved = 0;
    for (std::size_t v = 0; v < made.mesh.positions.size(); ++v) {
        const std::uint32_t point = made.mesh.points[v];
        if (point == kNoPoint) continue;
        moved += made.mesh.positions[v] != made.scene.positions[point] ? 1 : 0;
    }
    return moved;
}

TEST(Reconstruct, DenoisesVerticesExceptWithMethodStrictOrDenseClouds)
{
    const Scene scene = bumpy_sphere(kPoints, 9);
    const Reconstruction settled = run(scene);
    EXPECT_GT(num_moved(settled), static_cast<std::int64_t>(kPoints / 2));
    Options options;
    options.denoise.denoise = 0.0;
    const Reconstruction unsettled = run(scene, options);
    EXPECT_EQ(num_moved(unsettled), 0);
    EXPECT_EQ(unsettled.mesh.points, settled.mesh.points) << "labels are unaffected";
    EXPECT_EQ(unsettled.mesh.faces, settled.mesh.faces);
    options = {};
    options.labels.method = Method::strict;
    EXPECT_EQ(num_moved(run(scene, options)), 0);
    Scene dense = scene;
    dense.is_dense = true;
    EXPECT_EQ(num_moved(run(dense)), 0);
}

/// The number of vertices that are points added on creases.
std::int64_t num_added(const Reconstruction& made)
{
    return std::ranges::count_if(made.mesh.points, [&](std::uint32_t point) {
        return point != kNoPoint && made.scene.kind_of(point) == PointKind::crease;
    });
}

TEST(Reconstruct, AddsPointsAlongCreasesExceptWithMethodStrict)
{
    const Scene scene =
        read_colmap_model(fixtures_folder() / "scene/sparse/0", ModelFormat::binary);
    EXPECT_GT(num_added(run(scene)), 50);
    Options options;
    options.added_points.crease_reach = 0.0;
    EXPECT_EQ(num_added(run(scene, options)), 0);
    options = {};
    options.labels.method = Method::strict;
    EXPECT_EQ(num_added(run(scene, options)), 0);
}

} // namespace
} // namespace vcarve::reconstruct_test
