#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/told_log.h"
#include "vcarve/compare.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vcarve {

namespace {

using testing::HasSubstr;

} // namespace

TEST(CompareCall, GivesTheFiguresOfItsJsonAndATable)
{
    const Scene scene = bumpy_sphere(2000, 1);
    ToldLog log;
    const NamedMesh mesh = {"made.ply", reconstruct(scene, {}, log).mesh};
    const ComparisonReport report =
        compare(scene, std::span(&mesh, 1), &mesh, {.samples = 2000}, log);
    ASSERT_EQ(report.figures.size(), 1U);
    const nlohmann::json record = nlohmann::json::parse(report.json).at("meshes").at(0);
    const std::map<std::string, double>& figures = report.figures[0];
    EXPECT_EQ(figures.at("/size/faces"), static_cast<double>(mesh.mesh.faces.size()));
    EXPECT_EQ(figures.at("/views/hidden_sights"), record.at("views").at("hidden_sights"));
    EXPECT_EQ(figures.at("/truth/blocked"), 0.0); // the mesh is its own truth
    EXPECT_THAT(report.table, HasSubstr("made.ply"));
    EXPECT_THAT(log.ended(), testing::Contains("reference"));
    EXPECT_THAT(log.ended(), testing::Contains("measure"));
}

TEST(CompareCall, RefusesOptionsOutOfTheirRange)
{
    Log silent;
    EXPECT_EQ(refusal<UsageError>(
                  [&] { compare(bumpy_sphere(100, 1), {}, nullptr, {.samples = 10}, silent); }),
              "--samples takes a whole number from 1000 to 100000000, not 10");
}

} // namespace vcarve
