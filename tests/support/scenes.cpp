#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace vcarve {

namespace {

using Eigen::Vector3d;

Vector3d random_direction(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Vector3d{normal(random), normal(random), normal(random)}.normalized();
}

double bumpy_radius(const Vector3d& direction)
{
    return 1.0 + 0.15 * std::sin(5.0 * direction.x()) * std::cos(4.0 * direction.y());
}

} // namespace

Scene make_scene(const std::vector<Vector3d>& centers, const std::vector<MadePoint>& points)
{
    Scene scene;
    scene.cameras.push_back({1, 1, 640, 480, {500.0, 500.0, 320.0, 240.0}});
    for (const Vector3d& center : centers) {
        View view;
        view.id = static_cast<std::uint32_t>(scene.views.size() + 1);
        view.name = "view" + std::to_string(view.id);
        view.center = center;
        scene.views.push_back(view);
    }
    for (const MadePoint& point : points) {
        const auto id = scene.num_points() + 1;
        scene.positions.push_back(point.position);
        scene.colors.push_back(
            {static_cast<std::uint8_t>(id % 256), static_cast<std::uint8_t>(id / 256 % 256), 100});
        scene.errors_px.push_back(0.5);
        scene.point_ids.push_back(id);
        scene.tracks.push_back(point.views);
    }
    return scene;
}

Scene bumpy_sphere(std::size_t num_points, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<Vector3d> centers;
    for (int i = 0; i < 12; ++i) {
        const double angle = i * std::numbers::pi / 6.0;
        centers.emplace_back(4.0 * std::cos(angle), 4.0 * std::sin(angle), 2.0 * std::sin(3.0 * i));
    }
    std::normal_distribution<double> noise(0.0, 0.003);
    std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
    std::vector<MadePoint> points;
    while (points.size() < num_points) {
        const Vector3d direction = random_direction(random);
        const bool is_outlier = points.size() % 50 == 49;
        const Vector3d position =
            is_outlier ? Vector3d{anywhere(random), anywhere(random), anywhere(random)}
                       : Vector3d(direction * (bumpy_radius(direction) + noise(random)));
        MadePoint point{position, {}};
        for (std::uint32_t view = 0; view < centers.size(); ++view) {
            const Vector3d to_view = (centers[view] - position).normalized();
            if (direction.dot(to_view) > 0.35) {
                point.views.push_back(view);
            }
        }
        points.push_back(point);
    }
    return make_scene(centers, points);
}

Scene permuted(const Scene& scene, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<std::uint32_t> views(scene.views.size());
    std::iota(views.begin(), views.end(), 0U);
    std::shuffle(views.begin(), views.end(), random);
    std::vector<std::uint32_t> points(scene.num_points());
    std::iota(points.begin(), points.end(), 0U);
    std::shuffle(points.begin(), points.end(), random);

    Scene result;
    result.cameras = scene.cameras;
    result.is_dense = scene.is_dense;
    result.offset = scene.offset;
    std::vector<std::uint32_t> new_view(views.size());
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        new_view[views[i]] = i;
        result.views.push_back(scene.views[views[i]]);
    }
    for (const std::uint32_t point : points) {
        result.positions.push_back(scene.positions[point]);
        result.colors.push_back(scene.colors[point]);
        result.errors_px.push_back(scene.errors_px[point]);
        result.point_ids.push_back(scene.point_ids[point]);
        std::vector<std::uint32_t> track;
        for (const std::uint32_t view : scene.tracks[point]) {
            track.push_back(new_view[view]);
        }
        std::sort(track.begin(), track.end());
        result.tracks.push_back(track);
    }
    return result;
}

Scene moved(const Scene& scene, double scale, const Eigen::Quaterniond& rotation,
            const Vector3d& shift)
{
    Scene result = scene;
    for (Vector3d& position : result.positions) {
        position = scale * (rotation * position) + shift;
    }
    for (View& view : result.views) {
        view.center = scale * (rotation * view.center) + shift;
        view.cam_from_world = view.cam_from_world * rotation.conjugate();
    }
    return result;
}

} // namespace vcarve
