#include "steps/1_points/wide_angle.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vcarve::wide_angle_test {
namespace {

using Eigen::Vector3d;
using Rays = std::vector<Vector3d>;

double widest_angle_rad(const Rays& rays)
{
    double widest = 0.0;
    for (const Vector3d& a : rays) {
        for (const Vector3d& b : rays) {
            widest = std::max(widest, std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    return widest;
}

/// Rays from a point at a distance to cameras in the unit ball, or in a line.
Rays rays_to(std::size_t count, double distance, bool in_line, std::mt19937& random)
{
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const Vector3d way = Vector3d(coordinate(random), coordinate(random), coordinate(random));
    Rays rays;
    while (rays.size() < count) {
        const Vector3d place(coordinate(random), coordinate(random), coordinate(random));
        if (place.norm() > 1.0) continue;
        rays.push_back(distance * Vector3d(0.6, -0.48, 0.64) +
                       (in_line ? Vector3d(place.x() * way) : place));
    }
    return rays;
}

TEST(LookForAngle, FindsWhatComparingAllPairsFinds)
{
    std::mt19937 random(5);
    std::uniform_int_distribution<std::size_t> count(2, 40);
    std::uniform_real_distribution<double> exponent(-0.5, 5.0);
    int wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        const Rays rays =
            rays_to(count(random), std::pow(10.0, exponent(random)), i % 3 == 0, random);
        const double widest = widest_angle_rad(rays);
        for (const double share : {0.5, 0.95, 0.99, 0.999, 1.0, 1.001, 1.01, 1.1, 2.0}) {
            const double limit = share * widest;
            wrong += look_for_angle(rays, limit).is_found != (widest >= limit) ? 1 : 0;
        }
        const double above = std::nextafter(widest, 10.0);
        wrong += look_for_angle(rays, above).is_found ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
}

TEST(LookForAngle, FindsWhatComparingAllPairsFindsAtExtremeScales)
{
    std::mt19937 random(6);
    for (const double scale : {1e-90, 1e-50, 1e50, 1e90}) {
        for (int i = 0; i < 100; ++i) {
            Rays rays = rays_to(12, 30.0, false, random);
            for (Vector3d& ray : rays) {
                ray *= scale;
            }
            rays[i % 12] = i % 2 == 0 ? Vector3d::Zero() : rays[0];
            const double widest = widest_angle_rad(rays);
            EXPECT_TRUE(look_for_angle(rays, widest).is_found);
            EXPECT_FALSE(look_for_angle(rays, std::nextafter(widest, 10.0)).is_found);
        }
    }
}

TEST(LookForAngle, ComputesFewAnglesPerRayUnlessTheWidestIsAtTheLimit)
{
    constexpr std::size_t kRays = 500;
    std::mt19937 random(7);
    for (int i = 0; i < 6; ++i) {
        const Rays rays = rays_to(kRays, 100.0, i % 2 == 0, random);
        const double widest = widest_angle_rad(rays);
        for (const double share : {0.5, 0.9, 0.994, 1.006, 1.1, 2.0}) {
            EXPECT_LT(look_for_angle(rays, share * widest).num_angles, kRays + 16) << share;
        }
    }
}

} // namespace
} // namespace vcarve::wide_angle_test
