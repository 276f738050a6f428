#pragma once

#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A point of a hand-made scene: its position, and the indices of the views that see it.
struct MadePoint {
    Eigen::Vector3d position;
    std::vector<std::uint32_t> views;
};

/// A scene from view centers and points. Ids start at 1, errors are 0.5 px, and each point has a
/// different color.
Scene make_scene(const std::vector<Eigen::Vector3d>& centers, const std::vector<MadePoint>& points);

/// A pinhole camera of 1000 x 1000 pixels that shows a width of 10 at distance 8.
inline Camera square_camera()
{
    return {.id = 1,
            .model = 1, // PINHOLE
            .width_px = 1000,
            .height_px = 1000,
            .params = {800, 800, 500, 500}};
}

/// A bumpy closed surface of about unit size, seen from a ring of views. Its points have a little
/// noise and are seen by the views in front of them. A few points are anywhere.
Scene bumpy_sphere(std::size_t num_points, std::uint32_t seed);

/// The same scene with points and views in another order. Points and views keep their ids.
Scene permuted(const Scene& scene, std::uint32_t seed);

/// The scene, including views, after x -> scale * (rotation * x) + shift.
Scene moved(const Scene& scene, double scale, const Eigen::Quaterniond& rotation,
            const Eigen::Vector3d& shift);

} // namespace vcarve
