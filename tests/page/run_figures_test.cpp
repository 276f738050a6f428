#include "page/page_scene.h"
#include "page/run_figures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// Nine right triangles with sides of 1, and one of 40 x 1, from points seen by two and three
/// views.
TriMesh triangles()
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i < 10; ++i) {
        const double x = 3.0 * i;
        const double length = i == 9 ? 40.0 : 1.0;
        mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + length, 0, 0}, {x, 1, 0}});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

Scene two_points()
{
    Scene scene = make_scene({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}},
                             {{{0, 0, 0}, {0, 1, 2}}, {{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {1, 2}}});
    scene.errors_px = {0.25, -1.0, 0.75};
    return scene;
}

TEST(SurfaceFigures, MeasureAreasAndPoints)
{
    const std::vector<std::int32_t> supports = {0, 0, 1, 2, 3, 1, 1, 1, 1, 1};
    const SurfaceFigures figures = surface_figures(triangles(), supports, two_points());
    EXPECT_EQ(figures.faces, 10);
    EXPECT_EQ(figures.unsupported_faces, 2);
    EXPECT_DOUBLE_EQ(figures.unsupported_area, 1.0 / 24.5);
    EXPECT_DOUBLE_EQ(figures.long_area, 20.0 / 24.5);
    EXPECT_EQ(figures.edge_lengths.values, 30);
    EXPECT_EQ(figures.edge_lengths.median, 1.0);
    EXPECT_EQ(figures.points, 3);
    EXPECT_EQ(figures.track_lengths.bounds, (std::vector<double>{2, 3, 4}));
    EXPECT_EQ(figures.track_lengths.counts, (std::vector<std::int64_t>{2, 1}));
    EXPECT_EQ(figures.errors_px.values, 2);
    EXPECT_EQ(figures.errors_px.median, 0.75);
}

TEST(SurfaceFigures, AreNoneOfNothing)
{
    const SurfaceFigures figures = surface_figures({}, {}, {});
    EXPECT_EQ(figures.unsupported_area, 0.0);
    const auto json = figures_json(figures);
    EXPECT_TRUE(json["histograms"]["edge_length"].is_null());
    EXPECT_TRUE(json["histograms"]["reprojection_error"].is_null());
}

TEST(PackedScene, TurnsTheMeanOfTheImagesUpAndStartsFromTheBestView)
{
    const auto json = packed_scene(two_points());
    // The views of make_scene are not turned: y is down, z forward.
    EXPECT_EQ(json["up"], (std::vector<double>{0, -1, 0}));
    EXPECT_EQ(json["start"]["view"], 1); // the only one that saw all points
    EXPECT_EQ(json["start"]["depth"], -5.0);
    EXPECT_EQ(json["views"].size(), 3U);
    EXPECT_EQ(json["views"][1]["forward"], (std::vector<double>{0, 0, 1}));
}

TEST(PackedScene, TellsTheSizeOfAnImageAtDistanceOne)
{
    Scene scene = two_points();
    for (Camera& camera : scene.cameras) {
        camera = {
            .id = 1, .model = 1, .width_px = 800, .height_px = 600, .params = {400, 500, 400, 300}};
    }
    const auto json = packed_scene(scene);
    EXPECT_EQ(json["views"][0]["half_size"], (std::vector<double>{1.0, 0.6}));
    scene.cameras[0].params = {100, 100, 400, 300}; // far too wide to be looked through
    EXPECT_EQ(packed_scene(scene)["views"][0]["half_size"], (std::vector<double>{1.5, 1.125}));
    scene.cameras[0].model = -1;
    EXPECT_TRUE(packed_scene(scene)["views"][0]["half_size"].is_null());
}

TEST(PackedScene, ShowsNoMoreThanItsLimits)
{
    const auto json = packed_scene(bumpy_sphere(500, 1), {.points = 50, .views = 3});
    EXPECT_EQ(json["points"]["of"], 500);
    EXPECT_EQ(json["points"]["positions"]["count"], 50);
    EXPECT_EQ(json["views"].size(), 3U);
    EXPECT_GT(json["views_of"], 3);
}

TEST(PackedScene, HoldsNothingOfNothing)
{
    const auto json = packed_scene({});
    EXPECT_TRUE(json["start"].is_null());
    EXPECT_EQ(json["views"].size(), 0U);
}

} // namespace
} // namespace vcarve
