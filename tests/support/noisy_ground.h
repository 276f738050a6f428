#pragma once

#include "base/numbers.h"
#include "vcarve/scene.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

namespace vcarve::testing {

inline constexpr double kFocalPx = 1000.0;
inline constexpr double kHeight = 10.0;      ///< of the views above the ground
inline constexpr double kHalfBaseline = 2.0; ///< half the distance between the views

/// Two views side by side, which look down.
inline Scene two_views()
{
    Scene scene;
    scene.cameras = {{.id = 1,
                      .model = 0,
                      .width_px = 1000,
                      .height_px = 1000,
                      .params = {kFocalPx, 500.0, 500.0}}};
    scene.views = {
        {.id = 1, .camera = 0, .name = "left", .center = {-kHalfBaseline, 0.0, kHeight}},
        {.id = 2, .camera = 0, .name = "right", .center = {kHalfBaseline, 0.0, kHeight}}};
    return scene;
}

inline void add(Scene& scene, const Eigen::Vector3d& position)
{
    scene.positions.push_back(position);
    scene.colors.push_back({0, 0, 0});
    scene.errors_px.push_back(-1.0);
    scene.point_ids.push_back(scene.num_points() - 1);
    scene.tracks.push_back(std::array<std::uint32_t, 2>{0, 1});
}

/// The height error of a point midway between the views if both image positions have an error of
/// one pixel: the vertical part of a pixel at the angle of the rays, for both views.
inline const double kUpOfAPixel = std::hypot(kHeight, kHalfBaseline) / kFocalPx *
                                  std::hypot(kHeight, kHalfBaseline) / kHalfBaseline /
                                  std::sqrt(2.0);

/// Normally distributed numbers (Box and Muller).
inline double normal_number(std::uint64_t index)
{
    return std::sqrt(-2.0 * std::log(1.0 - random_number(5, 2 * index))) *
           std::cos(2.0 * std::numbers::pi * random_number(5, 2 * index + 1));
}

/// A square of ground between the views. Points are .02 apart, at height `rise(x, y)` plus the
/// noise of `noise_px` pixels.
inline Scene ground(double noise_px, const std::function<double(double, double)>& rise)
{
    Scene scene = two_views();
    std::uint64_t index = 0;
    for (double x = -0.5; x < 0.5; x += 0.02) {
        for (double y = -0.5; y < 0.5; y += 0.02) {
            const double at_x = x + 0.005 * random_number(9, 2 * index);
            const double at_y = y + 0.005 * random_number(9, 2 * index + 1);
            const double error = noise_px * kUpOfAPixel * normal_number(index++);
            add(scene, {at_x, at_y, rise(at_x, at_y) + error});
        }
    }
    return scene;
}

inline double flat(double /*x*/, double /*y*/)
{
    return 0.0;
}

/// The root mean square height of positions above the ground.
inline double rms(const std::vector<Eigen::Vector3d>& positions,
                  const std::function<double(double, double)>& rise = flat)
{
    double sum = 0.0;
    for (const Eigen::Vector3d& position : positions) {
        sum += std::pow(position.z() - rise(position.x(), position.y()), 2);
    }
    return std::sqrt(sum / static_cast<double>(positions.size()));
}

} // namespace vcarve::testing
