// Makes what laser scanners measure of a scene whose geometry is known. Usage: render_scan FOLDER
// SCENE STATIONS [POINTS], where STATIONS scanners on tripods stand at centres of the scene's
// views, far from each other, or, where it is `carried`, one is carried from view to view; POINTS
// are measured in all, by default a million. render_views --list prints the scenes' names. Writes
// FOLDER/scan.ply and FOLDER/gt.ply, the truth.
#include "observed/scan.h"
#include "render/photo_scene.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>

namespace vcarve::observed {

namespace {

/// The first, then always the one that is farthest from those before.
std::vector<Eigen::Vector3d> spread_places(const std::vector<render::Pinhole>& views,
                                           std::size_t count)
{
    std::vector<Eigen::Vector3d> places = {views.front().center};
    const auto nearest_sq = [&](const render::Pinhole& view) {
        double least = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& place : places) {
            least = std::min(least, (view.center - place).squaredNorm());
        }
        return least;
    };
    while (places.size() < count) {
        places.push_back(std::ranges::max_element(views, {}, nearest_sq)->center);
    }
    return places;
}

std::vector<Beam> beams_of(const render::PhotoScene& scene, const std::string& stations,
                           std::size_t points)
{
    if (stations == "carried") {
        std::vector<Eigen::Vector3d> path;
        for (const render::Pinhole& view : scene.views) {
            path.push_back(view.center);
        }
        return carried_beams(path, points);
    }
    const std::size_t count = std::stoul(stations);
    std::vector<Beam> beams;
    for (const Eigen::Vector3d& place : spread_places(scene.views, count)) {
        const std::vector<Beam> more = tripod_beams(place, points / count);
        beams.insert(beams.end(), more.begin(), more.end());
    }
    return beams;
}

void write_all(const std::filesystem::path& folder, const std::string& name,
               const std::string& stations, std::size_t points)
{
    const render::PhotoScene scene = render::photo_scene(name);
    Scan measured = scan(scene.parts.mesh, beams_of(scene, stations, points));
    for (std::size_t i = 0; i < measured.positions.size(); ++i) {
        measured.positions[i] = scene.frame(measured.positions[i]);
        measured.scanners[i] = scene.frame(measured.scanners[i]);
    }
    std::filesystem::create_directories(folder);
    write_scan(folder / "scan.ply", measured, 0.0);
    TriMesh truth = scene.parts.mesh;
    for (Eigen::Vector3d& position : truth.positions) {
        position = scene.frame(position);
    }
    write_ply(folder / "gt.ply", truth, {.comments = {"the geometry behind " + name}});
    fmt::print("{}: {} points\n", name, measured.positions.size());
}

} // namespace

} // namespace vcarve::observed

int main(int argc, char** argv)
{
    if (argc < 4 || argc > 5) {
        fmt::print(stderr, "usage: render_scan FOLDER SCENE STATIONS|carried [POINTS]\n");
        return 2;
    }
    try {
        constexpr std::size_t kPoints = 1000000;
        vcarve::observed::write_all(argv[1], argv[2], argv[3],
                                    argc == 5 ? std::stoul(argv[4]) : kPoints);
    } catch (const std::exception& error) {
        fmt::print(stderr, "render_scan: {}\n", error.what());
        return 1;
    }
    return 0;
}
