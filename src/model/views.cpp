#include "model/views.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace vcarve {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

struct Ray {
    Vector3d way; ///< from the view to the point
    double focal_px = 0.0;
    bool measures_range = false;

    auto rank() const { return std::tuple(way.x(), way.y(), way.z(), focal_px, measures_range); }
};

/// The rays of a point, sorted so that rounding does not depend on the order of views.
std::vector<Ray> ordered_rays(const Scene& scene, std::size_t point,
                              const std::vector<double>& focals_px)
{
    std::vector<Ray> rays;
    rays.reserve(scene.tracks[point].size());
    for (const std::uint32_t v : scene.tracks[point]) {
        const View& view = scene.views[v];
        rays.push_back({scene.positions[point] - view.center, focals_px[view.camera],
                        scene.cameras[view.camera].measures_range});
    }
    std::ranges::sort(rays, {}, &Ray::rank);
    return rays;
}

Vector3d look_back(const View& view)
{
    return view.cam_from_world.conjugate() * -Vector3d::UnitZ();
}

} // namespace

Vector3d up_of(const Scene& scene)
{
    const auto up = mean_direction(scene, [&](const View& view) -> Vector3d {
        if (scene.cameras[view.camera].measures_range) return Vector3d::UnitZ();
        return view.cam_from_world.conjugate() * -Vector3d::UnitY();
    });
    if (up) return *up;
    return back_of(scene).value_or(Vector3d::UnitZ());
}

std::optional<Vector3d> back_of(const Scene& scene)
{
    return mean_direction(scene, look_back);
}

bool look_in_one_direction(const Scene& scene)
{
    constexpr double kOneWay = 0.97; // cosine of 14 degrees
    const auto way = [&](const View& view) -> Vector3d {
        if (scene.cameras[view.camera].measures_range) return Vector3d::Zero(); // all directions
        return look_back(view);
    };
    return mean_direction(scene, way, kOneWay).has_value();
}

std::vector<Eigen::Vector2d> pixel_grid(const Camera& camera, std::size_t most)
{
    std::vector<Eigen::Vector2d> pixels;
    if (camera.width_px == 0 || camera.height_px == 0) return pixels;
    const auto width_px = static_cast<double>(camera.width_px);
    const auto height_px = static_cast<double>(camera.height_px);
    const auto count = static_cast<double>(most);
    const double columns =
        std::clamp(std::round(std::sqrt(count * width_px / height_px)), 1.0, count);
    const double rows = std::floor(count / columns);
    for (double row = 0.5; row < rows; ++row) {
        for (double column = 0.5; column < columns; ++column) {
            pixels.emplace_back(column / columns * width_px, row / rows * height_px);
        }
    }
    return pixels;
}

Matrix3d covariance_of_a_pixel(const Scene& scene, std::size_t point,
                               const std::vector<double>& focals_px)
{
    Matrix3d information = Matrix3d::Zero();
    for (const Ray& ray : ordered_rays(scene, point, focals_px)) {
        const double distance_sq = ray.way.squaredNorm();
        const double pixels_sq = ray.focal_px * ray.focal_px / distance_sq;
        Matrix3d across = Matrix3d::Identity();
        if (!ray.measures_range) across -= ray.way * ray.way.transpose() / distance_sq;
        information += pixels_sq * across;
    }
    const double scale = information.trace() / 3.0;
    if (!(information.determinant() > 1e-12 * scale * scale * scale)) return Matrix3d::Zero();
    return information.inverse();
}

} // namespace vcarve
