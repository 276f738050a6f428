// example_scanner OUT.ply: uses your data instead of a COLMAP model. A laser scanner at a few known
// positions in a room measures points on walls, floor, ceiling and a column. Each scanner position
// is a view, and each measured point has a ray to its scanner. The library needs no more. The mesh
// of the room is written to OUT.ply.
#include <vcarve/vcarve.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>

namespace {

/// The first hit of a ray with the room, 4 x 3 x 2.5 m, or the column in its center.
Eigen::Vector3d measured(const Eigen::Vector3d& from, const Eigen::Vector3d& way)
{
    const Eigen::Array3d walls = (way.array() > 0.0).select(Eigen::Array3d(4.0, 3.0, 2.5), 0.0);
    double range = ((walls - from.array()) / way.array()).minCoeff();
    // The column: |from + range way - center| = radius, in the ground plane.
    const Eigen::Vector2d to_middle = Eigen::Vector2d(2.0, 1.5) - from.head<2>();
    const double level = way.head<2>().squaredNorm();
    const double half = to_middle.dot(way.head<2>()) / level;
    const double root = half * half - (to_middle.squaredNorm() - 0.3 * 0.3) / level;
    if (root > 0.0 && half > 0.0) range = std::min(range, half - std::sqrt(root));
    return from + range * way;
}

/// Adds the points that a scanner at `place` measures, in directions uniform on the sphere.
void add_scan(const Eigen::Vector3d& place, vcarve::Scene& scene)
{
    constexpr int kRays = 4000;
    const auto view = static_cast<std::uint32_t>(scene.views.size());
    scene.views.push_back({.id = view + 1, .camera = 0, .name = "scan", .center = place});
    for (int i = 0; i < kRays; ++i) {
        const double height = 1.0 - (2.0 * i + 1.0) / kRays;
        const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i + view;
        const double level = std::sqrt(1.0 - height * height);
        scene.positions.push_back(
            measured(place, {level * std::cos(turn), level * std::sin(turn), height}));
        scene.colors.push_back({200, 200, 200});
        scene.errors_px.push_back(-1.0); // unknown: a scanner has no reprojection error
        scene.point_ids.push_back(scene.positions.size());
        scene.tracks.push_back(std::array{view});
    }
}

} // namespace

int main(int count, char** words)
{
    if (count != 2) return 2;
    try {
        vcarve::Scene scene;
        // COLMAP's equirectangular lens shows all directions. One view is enough for a point.
        scene.cameras.push_back({.id = 1,
                                 .model = 17,
                                 .width_px = 4000,
                                 .height_px = 2000,
                                 .params = {4000, 2000},
                                 .measures_range = true});
        for (const Eigen::Vector3d& place :
             {Eigen::Vector3d(0.8, 0.7, 1.4), Eigen::Vector3d(3.2, 0.6, 1.2),
              Eigen::Vector3d(3.1, 2.3, 1.6), Eigen::Vector3d(0.7, 2.4, 1.1)}) {
            add_scan(place, scene);
        }
        vcarve::Log silent;
        const vcarve::TriMesh mesh = vcarve::reconstruct(std::move(scene), {}, silent).mesh;
        vcarve::write_ply(words[1], mesh, {});
        std::cout << mesh.faces.size() << " faces\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
