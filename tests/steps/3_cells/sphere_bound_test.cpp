#include "steps/3_cells/sphere_bound.h"
#include "support/point_sets.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace vcarve::sphere_bound_test {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vector3d, 4>;

Kernel::Point_3 exact(const Vector3d& p)
{
    return {p.x(), p.y(), p.z()};
}

bool is_inside(const Corners& c, const Vector3d& q)
{
    return CGAL::side_of_oriented_sphere(exact(c[0]), exact(c[1]), exact(c[2]), exact(c[3]),
                                         exact(q)) == CGAL::ON_POSITIVE_SIDE;
}

/// Four points in positive order, the last moved to `height` above the plane of the others.
Corners tetrahedron(std::mt19937_64& random, double height)
{
    Corners c;
    for (Vector3d& corner : c)
        corner = even_in_cube(random, -1.0, 1.0);
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    c[3] = (c[0] + c[1] + c[2]) / 3.0 + 0.3 * (c[1] - c[0]) + height * normal;
    if (CGAL::orientation(exact(c[0]), exact(c[1]), exact(c[2]), exact(c[3])) != CGAL::POSITIVE)
        std::swap(c[0], c[1]);
    return c;
}

TEST(SphereBound, NeverExcludesAPointInside)
{
    std::mt19937_64 random(91);
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double height = std::pow(10.0, even(random, -17.0, 0.0));
        const Corners corners = tetrahedron(random, height);
        const SphereBound bound = SphereBound::around(corners);
        // Close to the corners, where the last digits decide, and farther away.
        const Vector3d near = corners[pick(random, 4)] + std::pow(10.0, even(random, -17.0, 0.0)) *
                                                             even_in_cube(random, -1.0, 1.0);
        if (!is_inside(corners, near)) continue;
        ++inside;
        const Vector3d reach = even_in_cube(random, 0.0, 1.0).cwiseAbs();
        for (const SphereBound& one : {bound, bound.within({near - reach, near + reach})}) {
            ASSERT_LE(one.least_at(near), 0.0) << "height " << height;
            ASSERT_LE(one.least_in({near - reach, near}), 0.0);
            ASSERT_LE(one.least_in({near, near + reach}), 0.0);
        }
        ASSERT_FALSE(bound.is_within(0.5 * (near - corners[0]).norm()));
    }
    EXPECT_GT(inside, 5000);
}

TEST(SphereBound, ExcludesPointsClearlyOutside)
{
    const Vector3d far = Vector3d::Constant(1e3);
    std::mt19937_64 random(92);
    for (const double height : {1.0, 1e-3, 1e-6, 1e-12}) {
        int told = 0;
        int outside = 0;
        for (int i = 0; i < 1000; ++i) {
            const Corners corners = tetrahedron(random, height);
            const Vector3d q = even_in_cube(random, -2.0, 2.0);
            if (is_inside(corners, q)) continue;
            ++outside;
            const SphereBound bound = SphereBound::around(corners);
            const bool has_visibility = bound.least_at(q) > 0.0;
            ASSERT_EQ(bound.within({-far, far}).least_at(q) > 0.0, has_visibility);
            if (has_visibility) ++told;
        }
        EXPECT_GT(told, 0.99 * outside) << height;
    }
}

TEST(SphereBound, BoundsTheDiameter)
{
    // Corners of the unit cube, whose diagonal is the diameter.
    const SphereBound bound =
        SphereBound::around({Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    EXPECT_FALSE(bound.is_within(std::sqrt(3.0)));
    EXPECT_TRUE(bound.is_within(1.01 * std::sqrt(3.0)));
}

TEST(SphereBound, DistinguishesTheSidesOfAPlane)
{
    const SphereBound bound = SphereBound::beyond({Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}});
    EXPECT_LT(bound.least_at({5, 5, 1e-9}), 0.0); // orientation is positive above
    EXPECT_GT(bound.least_at({5, 5, -1e-9}), 0.0);
    EXPECT_LE(bound.least_at({5, 5, 0}), 0.0);
    EXPECT_LT(bound.least_in({{-9, -9, -9}, {9, 9, 1}}), 0.0);
    EXPECT_GT(bound.least_in({{-9, -9, -9}, {9, 9, -1}}), 0.0);
    EXPECT_FALSE(bound.is_within(1e300));
}

} // namespace
} // namespace vcarve::sphere_bound_test
