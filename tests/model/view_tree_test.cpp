#include "model/camera.h"
#include "model/view_tree.h"
#include "support/made_cells.h"
#include "support/point_sets.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace vcarve::view_tree_test {
namespace {

using Eigen::Vector3d;
using testing::aim;

/// A random position in a cube, in steps of a thousandth of half its side.
Vector3d anywhere(std::mt19937_64& random, double half)
{
    const auto coordinate = [&] {
        return half * (static_cast<double>(pick(random, 2001)) / 1000.0 - 1.0);
    };
    return {coordinate(), coordinate(), coordinate()};
}

/// `num_views` views in a cube of half side 4, in groups of four. The views of a group are close
/// together and look at the same position, as in a video.
Scene views_in_a_cube(std::size_t num_views, std::uint32_t seed)
{
    Scene scene = make_scene(std::vector<Vector3d>(num_views, Vector3d::Zero()), {});
    std::mt19937_64 random(seed);
    Vector3d together = Vector3d::Zero();
    Vector3d target = Vector3d::Zero();
    for (std::size_t i = 0; i < num_views; ++i) {
        if (i % 4 == 0) {
            together = anywhere(random, 4.0);
            target = anywhere(random, 2.0);
        }
        scene.views[i].center = together + anywhere(random, 0.02);
        aim(scene.views[i], target);
    }
    return scene;
}

/// All visited views in order, if none is accepted.
std::vector<std::uint32_t> asked_about(const ViewTree& tree, const Vector3d& place,
                                       const Vector3d& normal)
{
    std::vector<std::uint32_t> asked;
    EXPECT_FALSE(tree.any_from_nearest(place, normal, [&](std::uint32_t view) {
        asked.push_back(view);
        return false;
    }));
    return asked;
}

/// The views that show a position and are in front of the plane, in ascending distance.
std::vector<std::uint32_t> views_that_may_see(const Scene& scene, const Vector3d& place,
                                              const Vector3d& normal)
{
    std::vector<std::uint32_t> views;
    for (std::uint32_t i = 0; i < scene.views.size(); ++i) {
        const View& view = scene.views[i];
        const bool is_before = normal.isZero() || normal.dot(view.center - place) > 0.0;
        if (is_before && view_shows(view, scene.cameras[view.camera], place)) views.push_back(i);
    }
    std::ranges::stable_sort(
        views, {}, [&](std::uint32_t view) { return (scene.views[view].center - place).norm(); });
    return views;
}

struct Asked {
    std::size_t all = 0;
    std::size_t may_see = 0;
};

/// Expects that the visited views include all views that may see the position, in order.
Asked expect_asked_in_order(const Scene& scene, const ViewTree& tree, const Vector3d& place,
                            const Vector3d& normal)
{
    const std::vector<std::uint32_t> may_see = views_that_may_see(scene, place, normal);
    std::vector<std::uint32_t> asked = asked_about(tree, place, normal);
    const std::size_t count = asked.size();
    std::erase_if(asked, [&](std::uint32_t view) {
        return std::ranges::find(may_see, view) == may_see.end();
    });
    EXPECT_EQ(asked, may_see);
    return {count, may_see.size()};
}

TEST(ViewTree, VisitsViewsThatMaySeeAPositionInAscendingDistance)
{
    const Scene scene = views_in_a_cube(512, 3);
    const ViewTree tree(scene);
    std::mt19937_64 random(5);
    Asked sum;
    for (int i = 0; i < 200; ++i) {
        const Vector3d place = anywhere(random, 3.0);
        expect_asked_in_order(scene, tree, place, Vector3d::Zero());
        const Asked asked = expect_asked_in_order(scene, tree, place, anywhere(random, 1.0));
        sum.all += asked.all;
        sum.may_see += asked.may_see;
    }
    EXPECT_LT(sum.all, 2 * sum.may_see);
}

TEST(ViewTree, BreaksTiesByIndex)
{
    const Vector3d side(1.0, 0.0, -5.0);
    Scene scene = make_scene({-side, side, {0.0, 0.0, -4.0}, side, {0.0, 0.0, -9.0}, side}, {});
    scene.views[0].center = {-1.0, 0.0, -5.0};
    EXPECT_THAT(asked_about(ViewTree(scene), Vector3d::Zero(), Vector3d::Zero()),
                ::testing::ElementsAre(2, 0, 1, 3, 5, 4));
}

TEST(ViewTree, SkipsNoViewsOfUnknownLenses)
{
    Scene scene = views_in_a_cube(50, 9);
    scene.cameras.front().model = -1;
    EXPECT_EQ(asked_about(ViewTree(scene), Vector3d::Zero(), Vector3d::Zero()).size(), 50U);
}

TEST(ViewTree, StopsAtTheFirstAcceptedViewAndHandlesMissingViews)
{
    Scene scene = views_in_a_cube(1, 11);
    aim(scene.views.front(), Vector3d::Zero());
    scene.views.resize(3, scene.views.front());
    scene.views[1].center.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(asked_about(ViewTree(scene), Vector3d::Zero(), Vector3d::Zero()),
                ::testing::ElementsAre(0, 2));
    int asked = 0;
    const auto yes = [&](std::uint32_t) { return ++asked > 0; };
    EXPECT_TRUE(ViewTree(scene).any_from_nearest(Vector3d::Zero(), Vector3d::Zero(), yes));
    EXPECT_EQ(asked, 1);
    scene.views.clear();
    EXPECT_FALSE(ViewTree(scene).any_from_nearest(Vector3d::Zero(), Vector3d::Zero(), yes));
    EXPECT_EQ(asked, 1);
}

} // namespace
} // namespace vcarve::view_tree_test
