#include "steps/2_planes/plane_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

const PlaneFrame kFrame(Plane{{1, 2, 3}, Vector3d::UnitZ()});

Vector3d at(double right, double up)
{
    return kFrame.in_space({right, up});
}

TEST(PlaneHull, ContainsWhatLiesWithinAndOnItsBorder)
{
    // An octagon, and places within.
    const PlaneHull hull({at(1, 0), at(3, 0), at(4, 1), at(4, 3), at(3, 4), at(1, 4), at(0, 3),
                          at(0, 1), at(2, 2), at(1, 1), at(2, 0), at(0, 2)},
                         kFrame);
    for (int i = -4; i <= 20; ++i) {
        for (int j = -4; j <= 20; ++j) {
            const double x = 0.25 * i;
            const double y = 0.25 * j;
            const bool is_within = x >= 0 && x <= 4 && y >= 0 && y <= 4 && x + y >= 1 &&
                                   x + y <= 7 && std::abs(x - y) <= 3;
            EXPECT_EQ(hull.contains(at(x, y)), is_within) << x << " " << y;
        }
    }
    double area = 0.0;
    for (const auto& [a, b, c] : hull.triangles()) {
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    EXPECT_NEAR(area, 14.0, 1e-12);
}

TEST(PlaneHull, ContainsNothingWhereAllLiesOnOneLine)
{
    const PlaneHull hull({at(0, 0), at(1, 1), at(2, 2)}, kFrame);
    EXPECT_FALSE(hull.contains(at(0, 1)));
    EXPECT_FALSE(hull.contains(at(3, 3)));
    EXPECT_TRUE(hull.triangles().empty());
    EXPECT_TRUE(PlaneHull({at(0, 0)}, kFrame).triangles().empty());
}

} // namespace
} // namespace vcarve
