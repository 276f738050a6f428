#include "geometry/predicates.h"

#include <gtest/gtest.h>

namespace vcarve::predicates_test {
namespace {

using Eigen::Vector3d;

TEST(Orientation, IsPositiveIfFirstThreeAreCounterClockwiseSeenFromFourth)
{
    const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(orientation(a, b, c, Vector3d(0, 0, 1)), 1);
    EXPECT_EQ(orientation(a, b, c, Vector3d(0, 0, -1)), -1);
    EXPECT_EQ(orientation(a, b, c, Vector3d(5, 7, 0)), 0);
}

TEST(Orientation, IsExactIfDeterminantRoundsToZero)
{
    const Vector3d a(0.1, 0.1, 0.1), b(0.2, 0.2, 0.2), c(0.3, 0.7, 0.1);
    const Vector3d on_plane = b; // a repeated point spans no volume
    const Vector3d above(0.2, 0.2, std::nextafter(0.2, 1.0));
    EXPECT_EQ(orientation(a, b, c, on_plane), 0);
    EXPECT_NE(orientation(a, b, c, above), 0);
}

TEST(Collinear, HoldsOnlyForPointsOnOneLine)
{
    EXPECT_TRUE(collinear(Vector3d(0, 0, 0), Vector3d(1, 2, 3), Vector3d(2, 4, 6)));
    EXPECT_FALSE(collinear(Vector3d(0, 0, 0), Vector3d(1, 2, 3), Vector3d(2, 4, 6.0000000001)));
}

TEST(MeetsTriangle, IncludesTheBoundary)
{
    const std::array<Vector3d, 3> triangle = {Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}};
    const auto meets_at = [&](double x, double y) {
        return meets_triangle(Vector3d(x, y, -1), Vector3d(x, y, 1), triangle);
    };
    EXPECT_TRUE(meets_at(0.25, 0.25));
    EXPECT_TRUE(meets_at(0.5, 0.5));
    EXPECT_TRUE(meets_at(0, 0));
    EXPECT_FALSE(meets_at(std::nextafter(0.5, 1.0), 0.5));
    EXPECT_TRUE(meets_triangle(Vector3d(0.2, 0.2, 0), Vector3d(0.2, 0.2, 1), triangle));
    EXPECT_FALSE(meets_triangle(Vector3d(0.2, 0.2, 1e-300), Vector3d(0.2, 0.2, 1), triangle));
    EXPECT_TRUE(
        meets_triangle(Vector3d(-1, 0.2, 0), Vector3d(1, 0.2, 0), triangle)); // in its plane
    EXPECT_FALSE(meets_triangle(Vector3d(-1, 2, 0), Vector3d(1, 2, 0), triangle));
}

} // namespace
} // namespace vcarve::predicates_test
