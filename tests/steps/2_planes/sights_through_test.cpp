#include "geometry/predicates.h"
#include "steps/2_planes/sights_through.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace vcarve::sights_through_test {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;
using Counts = std::vector<std::uint32_t>;

/// A triangle around the z axis, so high.
Triangle across(double z)
{
    return {Vector3d(-1.0, -1.0, z), Vector3d(2.0, -1.0, z), Vector3d(-1.0, 2.0, z)};
}

/// Points at height 0 beside the axis, seen by a view at height 10.
Scene upward(int points)
{
    std::vector<MadePoint> made;
    for (int i = 0; i < points; ++i) {
        made.push_back({{0.01 * i, 0.0, 0.0}, {0}});
    }
    return make_scene({{0.0, 0.0, 10.0}}, made);
}

Counts count(const Scene& scene, const std::vector<Triangle>& triangles, double margin)
{
    return sights_through(scene, triangles, std::vector<double>(scene.num_points(), margin), {});
}

TEST(SightsThrough, AreThoseThatMeetTheTriangle)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto anywhere = [&] {
        const double x = place(random);
        const double y = place(random);
        return Vector3d(x, y, place(random));
    };
    std::vector<MadePoint> points(200);
    for (MadePoint& point : points) {
        point = {anywhere(), {0, 1, 2}};
    }
    const Scene scene = make_scene({anywhere(), anywhere(), anywhere()}, points);
    std::vector<Triangle> triangles(20);
    for (Triangle& triangle : triangles) {
        triangle = {anywhere(), anywhere(), anywhere()};
    }
    Counts expected(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t point = 0; point < scene.num_points(); ++point) {
            for (const View& view : scene.views) {
                expected[i] +=
                    meets_triangle(scene.positions[point], view.center, triangles[i]) ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(count(scene, triangles, 0.0), expected);
    EXPECT_GT(*std::ranges::max_element(expected), 20U);
}

TEST(SightsThrough, DoNotReachTheirPoints)
{
    const std::vector<Triangle> triangles = {across(0.5), across(1.5), across(4.5), across(5.5)};
    EXPECT_EQ(count(upward(3), triangles, 1.0), Counts({0, 3, 3, 3}));
    // half of the sight at most
    EXPECT_EQ(count(upward(3), triangles, 100.0), Counts({0, 0, 0, 3}));
}

TEST(SightsThrough, AreNoneOfAPointInItsView)
{
    const Scene scene = make_scene({{0.0, 0.0, 0.0}}, {{{0.0, 0.0, 0.0}, {0}}});
    EXPECT_EQ(count(scene, {across(0.0)}, 0.0), Counts({0}));
    EXPECT_EQ(count(scene, {}, 0.0), Counts());
}

} // namespace
} // namespace vcarve::sights_through_test
