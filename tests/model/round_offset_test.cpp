#include "support/scenes.h"
#include "vcarve/io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vcarve::round_offset_test {
namespace {

using Eigen::Vector3d;

/// A cloud of `size` across around a place.
Scene cloud_at(const Vector3d& place, double size)
{
    return moved(bumpy_sphere(500, 1), size / 2.0, Eigen::Quaterniond::Identity(), place);
}

TEST(RoundOffset, IsRoundAndNearTheModel)
{
    // The middle nine tenths of a ball 40 across measure some 60 across their diagonal
    EXPECT_EQ(round_offset(cloud_at({500123.4, 4600987.6, 5270.0}, 40.0)),
              Vector3d(500100.0, 4601000.0, 5300.0));
    EXPECT_EQ(round_offset(cloud_at({-500123.4, 0.0, 0.0}, 4.0)), Vector3d(-500120.0, 0.0, 0.0));
    EXPECT_EQ(round_offset(cloud_at({12.3456, 0.0, 0.0}, 0.04)), Vector3d(12.3, 0.0, 0.0));
}

TEST(RoundOffset, IsNoneAlongAxesWhereTheModelLiesNearTheOrigin)
{
    EXPECT_EQ(round_offset(cloud_at({0.0, 0.0, 0.0}, 4.0)), Vector3d(0, 0, 0));
    EXPECT_EQ(round_offset(cloud_at({5e5, 4.6e6, 100.0}, 40.0)), Vector3d(5e5, 4.6e6, 0.0));
    EXPECT_EQ(round_offset(cloud_at({5e5, 4.6e6, 100.0}, 1e5)), Vector3d(0.0, 5e6, 0.0));
}

TEST(RoundOffset, LeavesCoordinatesThatFitIntoFloats)
{
    for (const double size : {1e-3, 0.4, 7.0, 300.0, 1e5}) {
        for (double far = 0.1; far < 1e7; far *= 1.7) {
            const Scene scene = cloud_at({far, -far, 0.3 * far}, size);
            const Vector3d offset = round_offset(scene);
            double worst = 0.0;
            for (const Vector3d& position : scene.positions) {
                const Vector3d left = position - offset;
                worst = std::max(worst,
                                 (left - left.cast<float>().cast<double>()).cwiseAbs().maxCoeff());
            }
            EXPECT_LT(worst, 1e-6 * size) << far << " " << size;
        }
    }
}

TEST(RoundOffset, CountsFinitePointsInTheFrameOfTheFile)
{
    Scene scene = cloud_at({23.4, 0.0, 0.0}, 4.0);
    scene.positions[7].x() = std::numeric_limits<double>::quiet_NaN();
    scene.offset = {500100.0, 0.0, 0.0};
    EXPECT_EQ(round_offset(scene), Vector3d(500120.0, 0.0, 0.0));
}

TEST(RoundOffset, IsNoneWhereThereIsNoSize)
{
    EXPECT_EQ(round_offset({}), Vector3d(0, 0, 0));
    EXPECT_EQ(round_offset(make_scene({}, {{{5e5, 0, 0}, {}}, {{5e5, 0, 0}, {}}})),
              Vector3d(0, 0, 0));
}

} // namespace
} // namespace vcarve::round_offset_test
