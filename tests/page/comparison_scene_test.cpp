#include "compare/worst_places.h"
#include "page/comparison_scene.h"
#include "page/display_mesh.h"
#include "page/pack.h"
#include "page/page_scene.h"
#include "support/measured_scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace vcarve::comparison_scene_test {
namespace {

using Json = nlohmann::ordered_json;

/// Colored points on a square, seen by four views.
Scene square_scene()
{
    Scene scene = testing::scene_above_square(11, testing::high_centers());
    scene.colors.assign(scene.num_points(), {1, 2, 3});
    return scene;
}

Json scene_of(const std::vector<NamedMesh>& meshes, bool with_truth)
{
    const Scene scene = square_scene();
    const NamedMesh truth{"gt.ply", testing::square()};
    const Reference reference =
        make_reference(scene, with_truth ? &truth : nullptr, testing::few_samples());
    return comparison_scene(packed_scene(scene), scene.offset, meshes, reference);
}

const NamedMesh kLow{"low.ply", testing::square(0.0)};
const NamedMesh kHigh{"high.ply", testing::square(0.25)};

/// `count` packed distances, all equal to `percent` of the diagonal.
std::string all_at(std::size_t count, double percent)
{
    return pack_errors(std::vector<double>(count, percent));
}

TEST(ComparisonScene, ListsTheTruthAfterTheMeshes)
{
    const Json scene = scene_of({kLow, kHigh}, true);
    const Json& surfaces = scene["surfaces"];
    ASSERT_EQ(surfaces.size(), 3U);
    EXPECT_EQ(surfaces[0]["name"], "low.ply");
    EXPECT_EQ(surfaces[1]["name"], "high.ply");
    EXPECT_EQ(surfaces[2]["name"], "truth");
    EXPECT_EQ(surfaces[1]["is_truth"], false);
    EXPECT_EQ(surfaces[2]["is_truth"], true);
    EXPECT_EQ(surfaces[1]["measured_to"], "the truth");
    EXPECT_EQ(surfaces[2]["measured_to"], nullptr);
    EXPECT_EQ(surfaces[2]["distances"], nullptr);
    EXPECT_EQ(scene["diagonal_of"], "truth");
}

TEST(ComparisonScene, ContainsDistancesOfVerticesAndBetween)
{
    const Json scene = scene_of({kLow, kHigh}, true);
    const double diagonal = scene["diagonal"];
    EXPECT_NEAR(diagonal, std::sqrt(2.0), 0.03);
    const Json& high = scene["surfaces"][1]["distances"];
    EXPECT_EQ(high["vertices"], all_at(4, 25.0 / diagonal));
    const std::vector<std::int32_t> parts = edge_parts(testing::square(), 0.005 * diagonal, 300000);
    EXPECT_EQ(high["parts"], pack_bytes(parts));
    EXPECT_EQ(high["between"],
              all_at(grid_places(testing::square(), parts).size(), 25.0 / diagonal));
    EXPECT_EQ(scene["surfaces"][0]["distances"]["vertices"], all_at(4, 0.0));
    // The distance is above all round ones, so colors end at 5 %.
    EXPECT_EQ(scene["scale"], 0.05);
}

TEST(ComparisonScene, EndsColorsAbove90PercentOfTheArea)
{
    EXPECT_EQ(scene_of({kLow}, true)["scale"], 0.001);
    EXPECT_EQ(scene_of({kLow, {"a.ply", testing::square(0.01)}}, true)["scale"], 0.01);
}

TEST(ComparisonScene, ListsAtMostFourWrongAndFourMissingPositions)
{
    const Json scene = scene_of({{"half.ply", testing::strip(0.0, 0.5, 0.0)}, kHigh}, true);
    const Json& half = scene["surfaces"][0];
    EXPECT_EQ(half["wrong"].size(), 0U);
    EXPECT_GE(half["missing"].size(), 2U);
    EXPECT_LE(half["missing"].size(), 4U);
    EXPECT_EQ(half["missing"][0]["views"], nullptr);
    const Json& high = scene["surfaces"][1];
    EXPECT_GE(high["wrong"].size(), 2U);
    EXPECT_LE(high["wrong"].size(), 4U);
    EXPECT_EQ(high["wrong"][0]["views"], 4);
    EXPECT_NEAR(high["wrong"][0]["distance"], 0.25 / scene["diagonal"].get<double>(), 1e-12);
}

TEST(ComparisonScene, MeasuresMeshesAgainstEachOtherWithoutATruth)
{
    const NamedMesh third{"third.ply", testing::square(0.1)};
    const Json scene = scene_of({kLow, kHigh, third}, false);
    const Json& surfaces = scene["surfaces"];
    ASSERT_EQ(surfaces.size(), 3U);
    EXPECT_EQ(surfaces[0]["measured_to"], "high.ply");
    EXPECT_EQ(surfaces[1]["measured_to"], "low.ply");
    EXPECT_EQ(surfaces[2]["measured_to"], "low.ply");
    EXPECT_EQ(scene["diagonal_of"], "points");
    const double diagonal = std::sqrt(2.0);
    EXPECT_EQ(surfaces[0]["distances"]["vertices"], all_at(4, 25.0 / diagonal));
    EXPECT_EQ(surfaces[2]["distances"]["vertices"], all_at(4, 10.0 / diagonal));
    EXPECT_EQ(surfaces[0]["missing"], nullptr);
    EXPECT_GE(surfaces[0]["wrong"].size(), 4U);
}

TEST(ComparisonScene, HasNoDistancesForASingleMesh)
{
    const Json surface = scene_of({kLow}, false)["surfaces"][0];
    EXPECT_EQ(surface["measured_to"], nullptr);
    EXPECT_EQ(surface["distances"], nullptr);
    EXPECT_EQ(surface["wrong"], nullptr);
}

TEST(ComparisonScene, IsInTheFrameOfTheReference)
{
    // Far from zero, floats would distort the drawing.
    Scene scene = square_scene();
    const Eigen::Vector3d far(5e5, 4e6, 100.0);
    scene.offset = far;
    TriMesh mesh = testing::square();
    mesh.offset = far;
    const Reference reference = make_reference(scene, nullptr, testing::few_samples());
    EXPECT_EQ(reference.origin, Eigen::Vector3d(far + Eigen::Vector3d(0.5, 0.5, 0.0)));
    const std::vector<NamedMesh> meshes = {{"a.ply", mesh}};
    const Json drawn = comparison_scene(packed_scene(scene), scene.offset, meshes, reference);
    EXPECT_EQ(drawn["surfaces"][0]["positions"]["low"], Json({-0.5, -0.5, 0.0}));
    EXPECT_EQ(drawn["points"]["positions"]["low"], Json({-0.5, -0.5, 0.0}));
    const Eigen::Vector3d center = testing::high_centers()[0];
    EXPECT_EQ(drawn["views"][0]["center"], Json({center.x() - 0.5, center.y() - 0.5, center.z()}));
    EXPECT_EQ(drawn["middle"]["center"], Json({0.0, 0.0, 0.0}));
}

} // namespace
} // namespace vcarve::comparison_scene_test
