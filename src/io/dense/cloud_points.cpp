#include "io/dense/cloud_points.h"

#include "base/parallel.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace vcarve {

namespace {

/// Of unit length, or zero where it is no direction.
void make_unit(Eigen::Vector3f& normal)
{
    const Eigen::Vector3d exact = normal.cast<double>();
    const double length = exact.norm();
    normal.setZero();
    if (length > 0.0 && std::isfinite(length)) normal = (exact / length).cast<float>();
}

} // namespace

void take_attributes(PointCloud cloud, std::uint64_t first, Scene& scene)
{
    const std::size_t num_points = scene.num_points();
    scene.normals = std::move(cloud.normals);
    parallel_for(scene.normals.size(), [&](std::size_t i) { make_unit(scene.normals[i]); });
    scene.colors = std::move(cloud.colors);
    scene.colors.resize(num_points, Color{});
    scene.is_dense = true;
    scene.errors_px.assign(num_points, -1.0);
    scene.point_ids.resize(num_points);
    std::iota(scene.point_ids.begin(), scene.point_ids.end(), first);
}

} // namespace vcarve
