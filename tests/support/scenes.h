#pragma once

#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A point of a scene made by hand: where it is and which views (by index) see it.
struct MadePoint {
    Eigen::Vector3d position;
    std::vector<std::uint32_t> views;
};

/// A scene from view centres and points. Ids count from 1, errors are 0.5 px, colours tell points
/// apart.
Scene make_scene(const std::vector<Eigen::Vector3d>& centers, const std::vector<MadePoint>& points);

/// A pinhole camera of 1000 x 1000 pixels that shows 10 across from 8 away.
inline Camera square_camera()
{
    return {.id = 1,
            .model = 1, // PINHOLE
            .width_px = 1000,
            .height_px = 1000,
            .params = {800, 800, 500, 500}};
}

/// A bumpy closed surface of about unit size seen from a ring of views: points on its surface with
/// a little noise, each seen by the views in front of it, and a few points that lie anywhere.
Scene bumpy_sphere(std::size_t num_points, std::uint32_t seed);

/// The same scene with points and views in another order; ids stay with their points and views.
Scene permuted(const Scene& scene, std::uint32_t seed);

/// The same scene after x -> scale * (rotation * x) + shift, views included.
Scene moved(const Scene& scene, double scale, const Eigen::Quaterniond& rotation,
            const Eigen::Vector3d& shift);

} // namespace vcarve
