#include "compare/compare.h"
#include "support/made_cells.h"
#include "support/measured_scenes.h"
#include "support/recording_log.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

namespace vcarve::compare_test {
namespace {

using testing::cube;
using testing::torus;

Comparison comparison_of(const TriMesh& mesh)
{
    const Scene scene = testing::scene_above_square(11, testing::high_centers());
    const Reference reference = make_reference(scene, nullptr, testing::few_samples());
    Log log;
    return compare_mesh({"a.ply", mesh}, reference, log);
}

TEST(Comparison, CountsVerticesFacesAndComponents)
{
    const Comparison comparison = comparison_of(cube());
    EXPECT_EQ(comparison.name, "a.ply");
    EXPECT_EQ(comparison.size.vertices, 8);
    EXPECT_EQ(comparison.size.faces, 12);
    EXPECT_DOUBLE_EQ(comparison.size.area, 6.0);
    EXPECT_EQ(comparison.size.components, 1);
    EXPECT_EQ(comparison.size.boundary_edges, 0);
    EXPECT_EQ(comparison.genus, 0);
    EXPECT_FALSE(comparison.truth.has_value());
}

TEST(Comparison, ReportsAFlippedFace)
{
    TriMesh mesh = cube();
    std::swap(mesh.faces[0][1], mesh.faces[0][2]);
    const Comparison comparison = comparison_of(mesh);
    EXPECT_EQ(comparison.size.orientation_faults, 3);
    EXPECT_FALSE(comparison.genus.has_value());
}

TEST(Comparison, ReportsAnInvertedMesh)
{
    // The edges are consistent, but no view sees the upper side from its front.
    TriMesh open = cube();
    open.faces.erase(open.faces.begin(), open.faces.begin() + 2);
    const Comparison right = comparison_of(testing::moved(open, {0.0, 0.0, -1.0}));
    const Comparison wrong =
        comparison_of(testing::flipped(testing::moved(cube(), {0.0, 0.0, -1.0})));
    EXPECT_EQ(wrong.size.orientation_faults, 0);
    // The views are above the square, so they see its top but no side.
    EXPECT_NEAR(right.evidence.unsupported_area, 0.8, 1e-3);
    EXPECT_EQ(wrong.evidence.unsupported_area, 1.0);
}

TEST(Genus, IsOneForATorus)
{
    EXPECT_EQ(genus(check_mesh(torus(8))), 1);
}

TEST(Genus, SumsOverComponents)
{
    const TriMesh far_torus = testing::moved(torus(8), {9.0, 0.0, 0.0});
    EXPECT_EQ(genus(check_mesh(testing::together(torus(8), far_torus))), 2);
    EXPECT_EQ(genus(check_mesh(testing::together(far_torus, cube()))), 1);
}

TEST(Genus, IsEmptyForAnOpenSurface)
{
    EXPECT_FALSE(genus(check_mesh(testing::square())).has_value());
}

TEST(Genus, IsEmptyIfTwoCubesShareAVertex)
{
    TriMesh mesh = testing::together(cube(), testing::moved(cube(), {1.0, 1.0, 1.0}));
    for (Face& face : mesh.faces) {
        for (std::uint32_t& vertex : face) {
            if (vertex == 8) vertex = 7;
        }
    }
    EXPECT_FALSE(genus(check_mesh(mesh)).has_value());
}

TEST(CompareCall, ReturnsFiguresJsonAndATable)
{
    const Scene scene = bumpy_sphere(2000, 1);
    RecordingLog log;
    const NamedMesh mesh = {"made.ply", reconstruct(scene, {}, log).mesh};
    const ComparisonReport report =
        compare(scene, std::span(&mesh, 1), &mesh, {.samples = 2000}, log);
    ASSERT_EQ(report.figures.size(), 1U);
    const nlohmann::json record = nlohmann::json::parse(report.json).at("meshes").at(0);
    const std::map<std::string, double>& figures = report.figures[0];
    EXPECT_EQ(figures.at("/size/faces"), static_cast<double>(mesh.mesh.faces.size()));
    EXPECT_EQ(figures.at("/views/hidden_rays"), record.at("views").at("hidden_rays"));
    EXPECT_EQ(figures.at("/truth/blocked"), 0.0); // the mesh is its own truth
    EXPECT_THAT(report.table, ::testing::HasSubstr("made.ply"));
    EXPECT_THAT(log.ended(), ::testing::Contains("reference"));
    EXPECT_THAT(log.ended(), ::testing::Contains("measure"));
}

TEST(CompareCall, IsByteIdenticalForAnyThreadCount)
{
    Log silent;
    Scene scene = bumpy_sphere(1000, 1);
    for (View& view : scene.views) {
        testing::aim(view, Eigen::Vector3d::Zero());
    }
    const NamedMesh truth = {"truth.ply", reconstruct(scene, {}, silent).mesh};
    const NamedMesh soup = {"soup.ply", testing::random_soup(100, 5)};
    const auto json_on = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return compare(scene, std::span(&soup, 1), &truth, {.samples = 20000}, silent).json;
    };
    const std::string alone = json_on(1);
    EXPECT_EQ(alone, json_on(3));
    const auto figures = nlohmann::json::parse(alone).at("meshes").at(0);
    EXPECT_GT(figures.at("truth").at("torn"), 0.0);
    EXPECT_GT(figures.at("views").at("back_faces_seen"), 0.0);
}

TEST(CompareCall, RejectsOptionsOutOfRange)
{
    Log silent;
    EXPECT_EQ(refusal<UsageError>(
                  [&] { compare(bumpy_sphere(100, 1), {}, nullptr, {.samples = 10}, silent); }),
              "--samples takes a whole number from 1000 to 100000000, not 10");
}

} // namespace
} // namespace vcarve::compare_test
