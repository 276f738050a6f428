// example_scanner OUT.ply: evidence of one's own instead of a COLMAP model. A laser scanner stands
// at a few known places in a room and measures points on its walls, floor, ceiling and on a column.
// That is all the library needs: each place is a view, each measured point has a sight to the place
// it was measured from. The mesh, of the room seen from within, is written to OUT.ply.
#include <vcarve/vcarve.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>

namespace {

/// Where a ray from within the room, 4 x 3 x 2.5 m, first meets it or the column in its middle.
Eigen::Vector3d measured(const Eigen::Vector3d& from, const Eigen::Vector3d& way)
{
    const Eigen::Array3d walls = (way.array() > 0.0).select(Eigen::Array3d(4.0, 3.0, 2.5), 0.0);
    double range = ((walls - from.array()) / way.array()).minCoeff();
    // The column: |from + range way - middle| = radius, seen from above.
    const Eigen::Vector2d to_middle = Eigen::Vector2d(2.0, 1.5) - from.head<2>();
    const double level = way.head<2>().squaredNorm();
    const double half = to_middle.dot(way.head<2>()) / level;
    const double root = half * half - (to_middle.squaredNorm() - 0.3 * 0.3) / level;
    if (root > 0.0 && half > 0.0) range = std::min(range, half - std::sqrt(root));
    return from + range * way;
}

/// Adds what a scanner at `place` measures: directions spread evenly over the sphere.
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
        scene.errors_px.push_back(-1.0); // a scanner has none
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
        // It looks all round, COLMAP's equirectangular lens, and one view tells where a point is.
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
