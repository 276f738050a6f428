#include "io/images/encode_image.h"
#include "page/pack.h"
#include "page/page_scene.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace vcarve::page_scene_test {
namespace {

Scene two_points()
{
    Scene scene = make_scene({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}},
                             {{{0, 0, 0}, {0, 1, 2}}, {{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {1, 2}}});
    scene.errors_px = {0.25, -1.0, 0.75};
    return scene;
}

TEST(PackedScene, UsesTheMeanUpDirectionAndTheBestView)
{
    const auto json = packed_scene(two_points());
    // The views of make_scene are not rotated: y is down, z is forward.
    EXPECT_EQ(json["up"], (std::vector<double>{0, -1, 0}));
    EXPECT_EQ(json["start"]["view"], 1); // the only view that sees all points
    EXPECT_EQ(json["start"]["depth"], -5.0);
    EXPECT_EQ(json["views"].size(), 3U);
    EXPECT_EQ(json["views"][1]["forward"], (std::vector<double>{0, 0, 1}));
}

TEST(PackedScene, ContainsTheImageSizeAtDistanceOne)
{
    Scene scene = two_points();
    for (Camera& camera : scene.cameras) {
        camera = {
            .id = 1, .model = 1, .width_px = 800, .height_px = 600, .params = {400, 500, 400, 300}};
    }
    const auto json = packed_scene(scene);
    EXPECT_EQ(json["views"][0]["half_size"], (std::vector<double>{1.0, 0.6}));
    scene.cameras[0].params = {100, 100, 400, 300}; // too wide to look through
    EXPECT_EQ(packed_scene(scene)["views"][0]["half_size"], (std::vector<double>{1.5, 1.125}));
    scene.cameras[0].model = -1;
    EXPECT_TRUE(packed_scene(scene)["views"][0]["half_size"].is_null());
}

TEST(PackedScene, RespectsItsLimits)
{
    const auto json = packed_scene(bumpy_sphere(500, 1), {.points = 50, .views = 3});
    EXPECT_EQ(json["points"]["of"], 500);
    EXPECT_EQ(json["points"]["positions"]["count"], 50);
    EXPECT_EQ(json["views"].size(), 3U);
    EXPECT_GT(json["views_of"], 3);
}

TEST(PackedScene, IsEmptyForAnEmptyScene)
{
    const auto json = packed_scene({});
    EXPECT_TRUE(json["start"].is_null());
    EXPECT_EQ(json["views"].size(), 0U);
}

TEST(PackedDepth, ContainsBothImagesAndTheNameOfTheView)
{
    Scene scene;
    scene.views.resize(2);
    scene.views[1].name = "b.jpg";
    const Photograph gray = {8, 8, std::vector<std::uint8_t>(3 * 64, 100)};
    const Photograph white = {8, 8, std::vector<std::uint8_t>(3 * 64, 255)};
    const auto json = packed_depth({1, gray, white}, scene);
    EXPECT_EQ(json["name"], "b.jpg");
    EXPECT_EQ(json["photograph"], base64(encode_jpeg(gray, 90)));
    EXPECT_EQ(json["depth"], base64(encode_jpeg(white, 90)));
    EXPECT_TRUE(packed_depth({}, scene).is_null());
}

TEST(PackedTexture, RespectsItsLimit)
{
    Texture texture;
    texture.pages = {Photograph{64, 32, std::vector<std::uint8_t>(3 * 64 * 32, 100)}};
    texture.page_of_face = {0};
    texture.places = {{{{0.0F, 1.0F}, {0.5F, 0.0F}, {1.0F, 0.25F}}}};
    const auto whole = packed_texture(texture);
    const auto small = packed_texture(texture, {.texels = 1000});
    EXPECT_GT(whole["pages"][0].get<std::string>().size(),
              small["pages"][0].get<std::string>().size());
    const std::vector<std::uint8_t> places = {0, 0, 255, 255, 0, 128, 0, 0, 255, 255, 0, 64};
    EXPECT_EQ(whole["places"].get<std::string>(), base64(places));
    EXPECT_EQ(whole["places"], small["places"]);
}

TEST(PackedTexture, IsNullWithoutPages)
{
    EXPECT_TRUE(packed_texture({}).is_null());
}

} // namespace
} // namespace vcarve::page_scene_test
