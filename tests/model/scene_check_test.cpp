#include "model/scene_check.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <array>

namespace vcarve::scene_check_test {

namespace {

/// Two views of one camera, and three points, the last of which has no views.
Scene small_scene()
{
    Scene scene;
    scene.cameras.resize(1);
    scene.views.resize(2);
    scene.views[1].id = 7;
    scene.positions.resize(3);
    scene.colors.resize(3);
    scene.errors_px.resize(3);
    scene.point_ids.resize(3);
    scene.tracks.push_back(std::array{0U, 1U});
    scene.tracks.push_back(std::array{1U});
    scene.tracks.push_back({});
    return scene;
}

template <typename Change>
std::string refusal_after(const Change& change)
{
    Scene scene = small_scene();
    change(scene);
    return refusal<UsageError>([&] { require_consistent(scene); });
}

} // namespace

TEST(SceneCheck, AcceptsConsistentScenes)
{
    EXPECT_NO_THROW(require_consistent(small_scene()));
    EXPECT_NO_THROW(require_consistent(Scene()));
    Scene with_normals = small_scene();
    with_normals.normals.resize(3);
    EXPECT_NO_THROW(require_consistent(with_normals));
}

TEST(SceneCheck, RejectsArraysWithoutOneEntryPerPoint)
{
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.colors.resize(2); }),
              "the scene's colors have 2 entries, expected 3 (one per point)");
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.errors_px.clear(); }),
              "the scene's errors_px have 0 entries, expected 3 (one per point)");
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.point_ids.resize(4); }),
              "the scene's point_ids have 4 entries, expected 3 (one per point)");
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.push_back({}); }),
              "the scene's tracks have 4 entries, expected 3 (one per point)");
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.kinds.resize(2); }),
              "the scene's kinds have 2 entries, expected 3 (one per point)");
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.normals.resize(2); }),
              "the scene's normals have 2 entries, expected 3 (one per point)");
}

TEST(SceneCheck, RejectsViewsWithoutCamera)
{
    EXPECT_EQ(
        refusal_after([](Scene& scene) { scene.views[1].camera = 1; }),
        "view 7 of the scene has camera index 1, expected an index below 1, the number of cameras");
}

TEST(SceneCheck, RejectsTracksWithoutAscendingViews)
{
    const std::string rows =
        "the scene's tracks.begins is invalid, expected ascending offsets from 0 "
        "to the size of tracks.views";
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.begins.clear(); }), rows);
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.begins.front() = 1; }), rows);
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.begins[1] = 4; }), rows);
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.views.push_back(0); }), rows);
    const auto of_point = [](int point) {
        return "the track of point " + std::to_string(point) +
               " of the scene is invalid, expected strictly ascending view indices below 2";
    };
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.views = {1, 0, 1}; }), of_point(0));
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.views = {1, 1, 1}; }), of_point(0));
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.views = {0, 1, 2}; }), of_point(1));
    EXPECT_EQ(refusal_after([](Scene& scene) { scene.tracks.views = {1, 0, 2}; }), of_point(0));
}

} // namespace vcarve::scene_check_test
