#include "run/scene_digest.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace vcarve {
namespace {

Scene two_points()
{
    Scene scene;
    scene.cameras.resize(1);
    scene.views.resize(2);
    scene.positions = {{1, 2, 3}, {4, 5, 6}};
    scene.colors = {{1, 2, 3}, {4, 5, 6}};
    scene.errors_px = {0.5, 0.25};
    scene.point_ids = {7, 8};
    scene.tracks.push_back(std::array{0U, 1U});
    scene.tracks.push_back(std::array{1U});
    return scene;
}

TEST(DigestOfScene, ChangesWithEveryNumber)
{
    const Scene scene = two_points();
    const Digest before = digest_of(scene);
    EXPECT_EQ(digest_of(scene), before);
    Scene moved = scene;
    moved.positions[0].z() += 1e-15;
    EXPECT_NE(digest_of(moved), before);
    Scene turned = scene;
    turned.views[0].cam_from_world.w() = -1.0;
    EXPECT_NE(digest_of(turned), before);
    Scene seen = scene;
    seen.tracks.views[2] = 0;
    EXPECT_NE(digest_of(seen), before);
    Scene colored = scene;
    colored.colors[1][0] = 5;
    EXPECT_NE(digest_of(colored), before);
}

TEST(DigestOfScene, DoesNotDependOnTheOrderOfThePoints)
{
    const Scene scene = two_points();
    Scene turned = scene;
    std::swap(turned.positions[0], turned.positions[1]);
    std::swap(turned.colors[0], turned.colors[1]);
    std::swap(turned.errors_px[0], turned.errors_px[1]);
    turned.tracks = Tracks();
    turned.tracks.push_back(scene.tracks[1]);
    turned.tracks.push_back(scene.tracks[0]);
    EXPECT_NE(digest_of(turned), digest_of(scene)) << "other numbers of the points";
    std::swap(turned.point_ids[0], turned.point_ids[1]);
    EXPECT_EQ(digest_of(turned), digest_of(scene));
}

} // namespace
} // namespace vcarve
