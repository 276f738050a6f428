#include "support/measured_scenes.h"

#include "base/numbers.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve::testing {
namespace {

double distance_to_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b)
{
    const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - t * (b - a)).norm();
}

} // namespace

TriMesh strip(double x0, double x1, double z)
{
    TriMesh mesh;
    mesh.positions = {{x0, 0, z}, {x1, 0, z}, {x1, 1, z}, {x0, 1, z}};
    mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

TriMesh square(double z)
{
    return strip(0.0, 1.0, z);
}

TriMesh cube()
{
    TriMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    }
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriMesh torus(std::uint32_t n)
{
    TriMesh mesh;
    const double step = 2.0 * std::numbers::pi / n;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const double radius = 1.0 + 0.3 * std::cos(j * step);
            mesh.positions.emplace_back(radius * std::cos(i * step), radius * std::sin(i * step),
                                        0.3 * std::sin(j * step));
            const std::uint32_t a = i * n + j;
            const std::uint32_t b = (i + 1) % n * n + j;
            const std::uint32_t c = (i + 1) % n * n + (j + 1) % n;
            const std::uint32_t d = i * n + (j + 1) % n;
            mesh.faces.push_back({a, b, c});
            mesh.faces.push_back({a, c, d});
        }
    }
    return mesh;
}

TriMesh together(const TriMesh& a, const TriMesh& b)
{
    TriMesh mesh = a;
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
    for (const Face& face : b.faces) {
        mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
    return mesh;
}

TriMesh moved(TriMesh mesh, const Eigen::Vector3d& shift)
{
    for (Eigen::Vector3d& position : mesh.positions) {
        position += shift;
    }
    return mesh;
}

TriMesh scaled(TriMesh mesh, double factor)
{
    for (Eigen::Vector3d& position : mesh.positions) {
        position *= factor;
    }
    return mesh;
}

TriMesh flipped(TriMesh mesh)
{
    for (Face& face : mesh.faces) {
        std::swap(face[1], face[2]);
    }
    return mesh;
}

TriMesh random_soup(std::size_t faces, std::uint64_t seed)
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i < faces; ++i) {
        for (std::uint64_t corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = 9 * i + 3 * corner;
            mesh.positions.emplace_back(random_number(seed, index), random_number(seed, index + 1),
                                        random_number(seed, index + 2));
        }
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

std::optional<FirstHit> first_hit_of_all(const TriMesh& mesh, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& towards)
{
    std::optional<FirstHit> nearest;
    const Eigen::Vector3d line = towards - from;
    for (const Face& face : mesh.faces) {
        const Eigen::Vector3d& a = mesh.positions[face[0]];
        const Eigen::Vector3d ab = mesh.positions[face[1]] - a;
        const Eigen::Vector3d ac = mesh.positions[face[2]] - a;
        Eigen::Matrix3d system;
        system << line, -ab, -ac;
        const Eigen::Vector3d place = system.inverse() * (a - from);
        if (place.minCoeff() < 0.0 || place.y() + place.z() > 1.0) continue;
        if (nearest && nearest->along <= place.x()) continue;
        nearest = {.along = place.x(), .front = ab.cross(ac).dot(line) < 0.0};
    }
    return nearest;
}

Scene scene_above_square(std::size_t n, const std::vector<Eigen::Vector3d>& centers)
{
    Scene scene;
    scene.cameras.push_back({.id = 1, .model = -1, .width_px = 0, .height_px = 0, .params = {}});
    std::vector<std::uint32_t> all;
    for (const Eigen::Vector3d& center : centers) {
        View view;
        view.cam_from_world = Eigen::Quaterniond(0, 1, 0, 0); // half a turn about x: look down
        view.center = center;
        all.push_back(static_cast<std::uint32_t>(scene.views.size()));
        scene.views.push_back(view);
    }
    const double step = 1.0 / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n * n; ++i) {
        scene.positions.emplace_back(static_cast<double>(i % n) * step,
                                     static_cast<double>(i / n) * step, 0.0);
        scene.tracks.push_back(all);
    }
    return scene;
}

Camera square_camera(std::uint64_t size_px, double tangent)
{
    const double middle_px = static_cast<double>(size_px) / 2;
    return {.id = 1,
            .model = 0,
            .width_px = size_px,
            .height_px = size_px,
            .params = {middle_px / tangent, middle_px, middle_px}};
}

std::vector<Eigen::Vector3d> high_centers()
{
    return {{0.2, 0.2, 10.0}, {0.8, 0.2, 10.0}, {0.2, 0.8, 10.0}, {0.8, 0.8, 10.0}};
}

double distance_to_face(const TriMesh& mesh, const Face& face, const Eigen::Vector3d& x)
{
    const Eigen::Vector3d& a = mesh.positions[face[0]];
    const Eigen::Vector3d& b = mesh.positions[face[1]];
    const Eigen::Vector3d& c = mesh.positions[face[2]];
    const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
    const Eigen::Vector3d foot = x - n * n.dot(x - a);
    const bool inside = (b - a).cross(foot - a).dot(n) >= 0 &&
                        (c - b).cross(foot - b).dot(n) >= 0 && (a - c).cross(foot - c).dot(n) >= 0;
    if (inside) return (x - foot).norm();
    return std::min(
        {distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, a)});
}

CompareOptions few_samples()
{
    CompareOptions options;
    options.samples = 20000;
    return options;
}

} // namespace vcarve::testing
