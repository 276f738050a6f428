#include "steps/1_points/arrange.h"

#include "base/statistics.h"
#include "geometry/point_order.h"
#include "model/scene_points.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The median on every axis, which is robust against far points and independent of the order.
Vector3d median_of(const std::vector<Vector3d>& positions)
{
    Vector3d median = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(positions.size());
        for (const Vector3d& position : positions) {
            if (std::isfinite(position[axis])) {
                values.push_back(position[axis]);
            }
        }
        median[axis] = median_in_place(values);
    }
    return median;
}

} // namespace

Scene center_points(Scene scene)
{
    move_origin(scene, median_of(scene.positions));
    return scene;
}

void move_origin(Scene& scene, const Vector3d& origin)
{
    for (Vector3d& position : scene.positions) {
        position -= origin;
    }
    for (View& view : scene.views) {
        view.center -= origin;
    }
    scene.offset += origin;
}

Scene spatial_sort(Scene scene, const Progress& progress)
{
    const std::vector<std::uint32_t> order = hilbert_order(scene.positions);
    progress.report(0.8);
    const auto row_of = [&](std::size_t i) { return scene.tracks[order[i]]; };
    keep_points(scene, order, make_tracks(order.size(), row_of));
    return scene;
}

} // namespace vcarve
