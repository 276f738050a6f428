#include "steps/1_points/center.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace vcarve::center_test {
namespace {

using Eigen::Vector3d;

TEST(CenterPoints, MovesTheMedianToTheOriginAndRecordsTheMove)
{
    const Scene scene = make_scene(
        {{500010, 0, 0}}, {{{500000, 1, 0}, {0}}, {{500002, 2, 0}, {0}}, {{900000, 3, 0}, {0}}});
    const Scene centered = center_points(scene);
    EXPECT_EQ(centered.offset, Vector3d(500002, 2, 0));
    EXPECT_EQ(centered.positions, (std::vector<Vector3d>{{-2, -1, 0}, {0, 0, 0}, {399998, 1, 0}}));
    EXPECT_EQ(centered.views[0].center, Vector3d(8, -2, 0));
}

TEST(CenterPoints, IgnoresCoordinatesThatAreNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Scene scene = make_scene({{0, 0, 0}}, {{{nan, 5, 5}, {0}}, {{3, 5, 5}, {0}}});
    EXPECT_EQ(center_points(scene).offset, Vector3d(3, 5, 5));
}

} // namespace
} // namespace vcarve::center_test
