#pragma once

#include "stereo/stereo_view.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace vcarve {

/// The depth of a surface along a ray, in lengths of the direction; 0 if the ray misses it.
using SurfaceAlong =
    std::function<double(const Eigen::Vector3d& from, const Eigen::Vector3d& along)>;

/// A random gray level for each corner of a grid of cubes.
inline double level_at(std::int64_t x, std::int64_t y, std::int64_t z)
{
    auto bits = static_cast<std::uint64_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
    bits = (bits ^ (bits >> 13U)) * 0x9e3779b97f4a7c15U;
    return 40.0 + static_cast<double>((bits >> 40U) % 176U);
}

/// A texture in space: random gray levels at a step of 0.05, interpolated in between.
inline double texture_at(const Eigen::Vector3d& place)
{
    const Eigen::Vector3d scaled = place / 0.05;
    const Eigen::Vector3d floor = scaled.array().floor();
    const Eigen::Vector3d share = scaled - floor;
    const auto corner = floor.cast<std::int64_t>();
    double level = 0.0;
    for (int i = 0; i < 8; ++i) {
        const int dx = i & 1;
        const int dy = (i >> 1) & 1;
        const int dz = i >> 2;
        level += (dx != 0 ? share.x() : 1.0 - share.x()) * (dy != 0 ? share.y() : 1.0 - share.y()) *
                 (dz != 0 ? share.z() : 1.0 - share.z()) *
                 level_at(corner.x() + dx, corner.y() + dy, corner.z() + dz);
    }
    return level;
}

/// The image of a textured surface from a camera that looks along z, 160 x 120 pixels. The
/// background is gray 30.
inline StereoView stereo_view_of(const SurfaceAlong& surface, std::uint32_t number,
                                 const Eigen::Vector3d& center)
{
    StereoView view;
    view.view = number;
    view.center = center;
    view.camera = {150.0F, {79.5F, 59.5F}};
    view.image = {160, 120, {}};
    for (int y = 0; y < view.image.height_px; ++y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            const Eigen::Vector3d ray =
                view.camera.ray(static_cast<float>(x), static_cast<float>(y)).cast<double>();
            const double depth = surface(center, ray);
            const double gray = depth > 0.0 ? texture_at(center + depth * ray) : 30.0;
            view.image.pixels.push_back(static_cast<float>(gray));
            if (x % kDepthStep == 0 && y % kDepthStep == 0) {
                view.colors.push_back({static_cast<std::uint8_t>(gray), 0, 0});
            }
        }
    }
    return view;
}

/// Five cameras around (0, 0, 0); the first is at this position.
inline std::vector<StereoView> five_views(const SurfaceAlong& surface)
{
    std::vector<StereoView> views;
    const std::vector<Eigen::Vector3d> centers = {
        {0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, {-0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}, {0.0, -0.3, 0.0}};
    for (const Eigen::Vector3d& center : centers) {
        views.push_back(stereo_view_of(surface, static_cast<std::uint32_t>(views.size()), center));
    }
    return views;
}

/// The plane normal . x = distance.
inline SurfaceAlong plane_along(const Eigen::Vector3d& normal, double distance)
{
    return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
        return (distance - normal.dot(from)) / normal.dot(along);
    };
}

} // namespace vcarve
