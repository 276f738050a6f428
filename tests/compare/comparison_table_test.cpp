#include "compare/comparison_table.h"
#include "support/measured_scenes.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace vcarve::comparison_table_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A square seen by all views, measured against itself.
Reference square_reference()
{
    const NamedMesh truth{"gt.ply", testing::square()};
    const Scene scene = testing::scene_above_square(11, testing::high_centers());
    return make_reference(scene, &truth, testing::few_samples());
}

Reference without_truth()
{
    const Scene scene = testing::scene_above_square(11, testing::high_centers());
    return make_reference(scene, nullptr, testing::few_samples());
}

std::vector<Comparison> two_meshes()
{
    Comparison a;
    a.name = "a.ply";
    a.size = {.vertices = 12, .faces = 20, .components = 2, .boundary_edges = 3, .area = 1.5};
    a.evidence = {.hidden_rays = 0.25,
                  .missed_points = 0.5,
                  .unsupported_area = 0.125,
                  .median_distance = 2.0,
                  .seen_boundary_edges = 2,
                  .rays = RayFigures{.back_faces_seen = 0.0625, .nothing_seen = 0.375}};
    Comparison b = a;
    b.evidence.rays->nothing_seen = std::nullopt;
    b.name = "longer_name.ply";
    b.genus = 3;
    return {a, b};
}

TEST(ComparisonTable, HasAColumnPerMesh)
{
    const std::string table = comparison_table(two_meshes(), without_truth());
    EXPECT_THAT(table, StartsWith("|                            |  a.ply | longer_name.ply |\n"
                                  "|----------------------------|-------:|----------------:|\n"
                                  "| vertices                   |     12 |              12 |\n"
                                  "| faces                      |     20 |              20 |\n"
                                  "| area                       |    1.5 |             1.5 |\n"
                                  "| components                 |      2 |               2 |\n"
                                  "| boundary edges             |      3 |               3 |\n"
                                  "| non-manifold edges         |      0 |               0 |\n"
                                  "| non-manifold vertices      |      0 |               0 |\n"
                                  "| orientation faults         |      0 |               0 |\n"
                                  "| degenerate faces           |      0 |               0 |\n"
                                  "| unreferenced vertices      |      0 |               0 |\n"
                                  "| genus                      |   open |               3 |\n"
                                  "| hidden rays                | 0.2500 |          0.2500 |\n"
                                  "| missed points              | 0.5000 |          0.5000 |\n"
                                  "| unsupported area           | 0.1250 |          0.1250 |\n"
                                  "| median distance [spacings] | 2.0000 |          2.0000 |\n"
                                  "| seen boundary edges        |      2 |               2 |\n"
                                  "| back faces seen            | 0.0625 |          0.0625 |\n"
                                  "| nothing seen               | 0.3750 |               - |\n"
                                  "\n"));
}

TEST(ComparisonTable, ExplainsTheFigures)
{
    const std::string plain = comparison_table(two_meshes(), without_truth());
    EXPECT_THAT(plain, HasSubstr("\nMeasured against 121 points with at least 2 views and 4 views; "
                                 "spacing of a point = distance to its 6th nearest point.\n"));
    EXPECT_THAT(plain,
                HasSubstr("\nmissed points: fraction of points more than 3 spacings from the "
                          "mesh.\n"));
    EXPECT_THAT(plain, HasSubstr("\nback faces seen: fraction of 0 rays, "));
    EXPECT_THAT(plain, HasSubstr("\nnothing seen: unknown, "));
    EXPECT_THAT(plain, Not(HasSubstr("truth")));
    const std::string full = comparison_table(two_meshes(), square_reference());
    EXPECT_THAT(full, HasSubstr("\ntruth: 20400 area samples of the part visible from at least "
                                "3 views "));
    EXPECT_THAT(full, HasSubstr("\nblocked: fraction of the truth's samples whose line "));
    EXPECT_THAT(full, HasSubstr("(20400 of 20400 samples have one)"));
}

TEST(ComparisonTable, HasNoRayFiguresIfNoViewHasARay)
{
    const Reference reference = without_truth();
    Log log;
    const std::vector<Comparison> one = {
        compare_mesh({"self.ply", testing::square()}, reference, log)};
    const std::string table = comparison_table(one, reference);
    EXPECT_THAT(table, HasSubstr("| back faces seen            |        - |\n"
                                 "| nothing seen               |        - |\n"));
    const auto report = nlohmann::json::parse(comparison_json(one, reference));
    EXPECT_TRUE(report["meshes"][0]["views"]["back_faces_seen"].is_null());
    EXPECT_TRUE(report["meshes"][0]["views"]["nothing_seen"].is_null());
}

TEST(ComparisonTable, HasTheTruthIfItIsKnown)
{
    const Reference reference = square_reference();
    Log log;
    const std::vector<Comparison> one = {
        compare_mesh({"self.ply", testing::square()}, reference, log)};
    const std::string table = comparison_table(one, reference);
    for (const char* row : {"| F 0.1 %                    |   1.0000 |\n",
                            "| F 0.25 %                   |   1.0000 |\n",
                            "| precision 0.5 %            |   1.0000 |\n",
                            "| recall 1 %                 |   1.0000 |\n",
                            "| mean accuracy [%]          |   0.0000 |\n",
                            "| mean completeness [%]      |   0.0000 |\n",
                            "| blocked                    |   0.0000 |\n",
                            "| seen right                 |   1.0000 |\n",
                            "| torn                       |   0.0000 |\n",
                            "| open                       |   0.0000 |\n"}) {
        EXPECT_THAT(table, HasSubstr(row));
    }
}

TEST(ComparisonTable, HasNoCameraRaysIfNoImageContainsTheTruth)
{
    Reference reference = square_reference();
    std::ranges::fill(reference.truth->image_views, kNoView);
    Log log;
    const std::vector<Comparison> one = {
        compare_mesh({"self.ply", testing::square()}, reference, log)};
    const std::string table = comparison_table(one, reference);
    EXPECT_THAT(table, HasSubstr("| seen right                 |        - |\n"));
    EXPECT_THAT(table, HasSubstr("(0 of 20400 samples have one)"));
    const auto report = nlohmann::json::parse(comparison_json(one, reference));
    EXPECT_EQ(report["truth"]["image_samples"], 0);
    EXPECT_TRUE(report["meshes"][0]["truth"]["open"].is_null());
}

/// a.ply was made for the comparison; making the other mesh failed.
std::vector<Comparison> a_run_and_a_failure()
{
    std::vector<Comparison> meshes = two_meshes();
    meshes[0].cost = {.seconds = 1.25, .cpu_seconds = 2.5, .peak_memory_bytes = 3'400'000};
    meshes[1].failure = "timed out after 300 s";
    return meshes;
}

TEST(ComparisonTable, ShowsCostsAndFailures)
{
    const std::string table = comparison_table(a_run_and_a_failure(), without_truth());
    EXPECT_THAT(table,
                HasSubstr("| vertices                   |     12 | timed out after 300 s |\n"
                          "| faces                      |     20 |                     - |\n"));
    EXPECT_THAT(table,
                HasSubstr("| seconds                    |   1.25 |                     - |\n"
                          "| CPU seconds                |   2.50 |                     - |\n"
                          "| peak memory [MB]           |    3.4 |                     - |\n"));
    EXPECT_THAT(table, HasSubstr("\nseconds, CPU seconds (all threads), peak memory: "));
    EXPECT_THAT(comparison_table(two_meshes(), without_truth()), Not(HasSubstr("seconds")));
}

TEST(ComparisonJson, ContainsCostsAndFailures)
{
    const auto json =
        nlohmann::json::parse(comparison_json(a_run_and_a_failure(), without_truth()));
    EXPECT_EQ(json["meshes"][0]["cost"],
              nlohmann::json(
                  {{"seconds", 1.25}, {"cpu_seconds", 2.5}, {"peak_memory_bytes", 3'400'000}}));
    EXPECT_EQ(json["meshes"][1],
              nlohmann::json({{"name", "longer_name.ply"}, {"failure", "timed out after 300 s"}}));
}

TEST(ComparisonJson, ContainsTheFiguresOfEveryMesh)
{
    const auto report = nlohmann::json::parse(comparison_json(two_meshes(), without_truth()));
    EXPECT_EQ(report["options"],
              nlohmann::json::parse(R"({"samples": 20000, "seed": 1, "spacings": 3.0})"));
    EXPECT_EQ(report["model"]["points"], 121);
    EXPECT_EQ(report["model"]["views"], 4);
    EXPECT_EQ(report["model"]["rays"], 484);
    EXPECT_TRUE(report["truth"].is_null());
    ASSERT_EQ(report["meshes"].size(), 2U);
    EXPECT_EQ(report["meshes"][1], nlohmann::json::parse(R"({
        "name": "longer_name.ply",
        "size": {"vertices": 12, "faces": 20, "area": 1.5, "components": 2, "boundary_edges": 3,
                 "nonmanifold_edges": 0, "nonmanifold_vertices": 0, "orientation_faults": 0,
                 "degenerate_faces": 0, "unreferenced_vertices": 0, "genus": 3},
        "views": {"hidden_rays": 0.25, "missed_points": 0.5, "unsupported_area": 0.125,
                  "median_distance": 2.0, "seen_boundary_edges": 2, "back_faces_seen": 0.0625,
                  "nothing_seen": null}})"));
    EXPECT_EQ(report["meshes"][0]["views"]["nothing_seen"], 0.375);
    EXPECT_EQ(report["schema"], 2);
    EXPECT_EQ(report["model"]["view_rays"], 0);
    EXPECT_TRUE(report["meshes"][0]["size"]["genus"].is_null());
}

TEST(ComparisonJson, ContainsTheTruth)
{
    const Reference reference = square_reference();
    std::vector<Comparison> meshes = two_meshes();
    meshes[0].truth = TruthFigures{.agreements = {{{0.001, 0.5, 1.0, 0.75}, {}, {}, {}}},
                                   .mean_accuracy = 0.1,
                                   .mean_completeness = 0.2,
                                   .blocked = 0.3,
                                   .lines = LineFigures{0.625, 0.125, 0.0625}};
    const auto report = nlohmann::json::parse(comparison_json(meshes, reference));
    EXPECT_EQ(report["truth"]["samples"], 20400);
    EXPECT_EQ(report["truth"]["image_samples"], 20400);
    EXPECT_EQ(report["truth"]["seen_share"], 1.0);
    const auto& truth = report["meshes"][0]["truth"];
    EXPECT_EQ(truth["agreement"][0], nlohmann::json::parse(R"(
        {"tolerance": 0.001, "f": 0.75, "precision": 0.5, "recall": 1.0})"));
    EXPECT_EQ(truth["mean_accuracy"], 0.1);
    EXPECT_EQ(truth["mean_completeness"], 0.2);
    EXPECT_EQ(truth["blocked"], 0.3);
    EXPECT_EQ(truth["seen_right"], 0.625);
    EXPECT_EQ(truth["torn"], 0.125);
    EXPECT_EQ(truth["open"], 0.0625);
}

} // namespace
} // namespace vcarve::comparison_table_test
