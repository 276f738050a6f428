#pragma once

#include "steps/1_points/arrange.h"
#include "steps/2_planes/added_points.h"
#include "support/scenes.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace vcarve::flat_scenes {

using Views = std::vector<std::uint32_t>;

/// Cameras look along z; y points down.
inline const std::vector<Eigen::Vector3d> kCenters = {{-0.5, 0, -6}, {0, -0.3, -6}, {0.5, 0, -6}};
inline const Views kAll = {0, 1, 2};

inline constexpr double kSpacing = 0.1;

/// Points on a rectangle, about kSpacing apart, slightly off rows and columns: `at(u, v)` with u
/// and v from `low` to `high`.
template <typename At>
std::vector<MadePoint> flat(const Eigen::Array2d& low, const Eigen::Array2d& high,
                            const Views& views, const At& at)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-0.02, 0.02);
    std::vector<MadePoint> points;
    for (double u = low[0]; u <= high[0]; u += kSpacing) {
        for (double v = low[1]; v <= high[1]; v += kSpacing) {
            const double off_u = off(random); // a fixed order for all compilers
            points.push_back({at(u + off_u, v + off(random)), views});
        }
    }
    return points;
}

/// The wall z = 0, which begins `gap` above the floor y = 1.
inline std::vector<MadePoint> wall(double gap, const Views& views = kAll)
{
    return flat({-1.0, -0.6}, {1.0, 1.0 - gap}, views,
                [](double u, double v) { return Eigen::Vector3d(u, v, 0.0); });
}

/// The floor, which begins `gap` in front of the wall.
inline std::vector<MadePoint> ground(double gap, const Views& views = kAll)
{
    return flat({-1.0, gap}, {1.0, 1.6}, views,
                [](double u, double v) { return Eigen::Vector3d(u, 1.0, -v); });
}

inline Scene together(const std::vector<std::vector<MadePoint>>& parts,
                      const std::vector<Eigen::Vector3d>& centers = kCenters)
{
    std::vector<MadePoint> points;
    for (const auto& part : parts) {
        points.insert(points.end(), part.begin(), part.end());
    }
    return spatial_sort(make_scene(centers, points));
}

/// The indices of the points of a kind.
inline std::vector<std::size_t> points_of_kind(const Scene& scene, PointKind kind)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        if (scene.kind_of(i) == kind) found.push_back(i);
    }
    return found;
}

inline Views track_of(const Scene& scene, std::size_t point)
{
    return {scene.tracks[point].begin(), scene.tracks[point].end()};
}

/// Points along a spiral on the unit sphere around the origin, `count` on the whole sphere. Only
/// points with z below `most_z` are returned.
inline std::vector<MadePoint> ball(int count, double most_z)
{
    std::vector<MadePoint> points;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / count;
        if (z >= most_z) continue;
        const double turn = i * std::acos(-1.0) * (3.0 - std::sqrt(5.0));
        const double radius = std::sqrt(1.0 - z * z);
        points.push_back({{radius * std::cos(turn), radius * std::sin(turn), z}, kAll});
    }
    return points;
}

/// Expects the same added points of a kind, up to `off` units, after scaling and moving the scene.
/// Their order may differ because of rounding.
inline void expect_same_elsewhere(const Scene& scene, const AddedPointOptions& options,
                                  PointKind kind, const std::vector<double>& scales, double off)
{
    Scene here = scene;
    add_points(here, options);
    const std::vector<std::size_t> added = points_of_kind(here, kind);
    for (const double scale : scales) {
        const Eigen::Vector3d shift(3.0 * scale, -5.0 * scale, 7.0 * scale);
        Scene there = moved(scene, scale, Eigen::Quaterniond::Identity(), shift);
        add_points(there, options);
        const std::vector<std::size_t> added_there = points_of_kind(there, kind);
        ASSERT_EQ(added_there.size(), added.size());
        for (const std::size_t i : added) {
            const Eigen::Vector3d place = scale * here.positions[i] + shift;
            const auto at = std::ranges::find_if(added_there, [&](std::size_t k) {
                return (there.positions[k] - place).norm() < off * scale;
            });
            ASSERT_NE(at, added_there.end());
            EXPECT_EQ(track_of(there, *at), track_of(here, i));
        }
    }
}

} // namespace vcarve::flat_scenes
