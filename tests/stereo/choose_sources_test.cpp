#include "stereo/choose_sources.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vcarve::choose_sources_test {
namespace {

using Eigen::Vector3d;
using Sources = std::vector<std::uint32_t>;

/// A viewpoint ten units from the origin, at this angle.
Vector3d at_deg(double angle)
{
    const double radians = angle * std::numbers::pi / 180.0;
    return {10.0 * std::sin(radians), 0.0, 10.0 * std::cos(radians)};
}

struct Input {
    Scene scene;
    std::vector<StereoView> views;
};

/// Views at these angles, all of which see the same `count` points near the origin.
Input views_at(const std::vector<double>& angles, int count)
{
    Input input;
    input.scene.cameras = {square_camera()};
    Sources all;
    for (const double angle : angles) {
        View view;
        view.center = at_deg(angle);
        all.push_back(static_cast<std::uint32_t>(all.size()));
        StereoView own;
        own.view = all.back();
        own.center = view.center;
        input.scene.views.push_back(view);
        input.views.push_back(own);
    }
    for (int i = 0; i < count; ++i) {
        input.scene.positions.emplace_back(0.001 * i, 0.0, 0.0);
        input.scene.tracks.push_back(all);
    }
    return input;
}

TEST(ChooseSources, PrefersAnglesOfThreeTo25Degrees)
{
    const Input input = views_at({0.0, 1.0, 40.0, 10.0}, 200);
    EXPECT_EQ(choose_sources(input.scene, input.views, 10)[0], (Sources{3, 2, 1}));
    EXPECT_EQ(choose_sources(input.scene, input.views, 2)[0], (Sources{3, 2}));
}

TEST(ChooseSources, SkipsViewsWithFewCommonPoints)
{
    const Input five = views_at({0.0, 10.0}, 5);
    EXPECT_EQ(choose_sources(five.scene, five.views, 10)[0], Sources());
    const Input six = views_at({0.0, 10.0}, 6);
    EXPECT_EQ(choose_sources(six.scene, six.views, 10)[0], Sources{1});
}

TEST(ChooseSources, SkipsViewsWithoutAPhotograph)
{
    Input input = views_at({0.0, 10.0, 20.0}, 10);
    input.views.erase(input.views.begin() + 1);
    EXPECT_EQ(choose_sources(input.scene, input.views, 10), (std::vector<Sources>{{1}, {0}}));
}

} // namespace
} // namespace vcarve::choose_sources_test
