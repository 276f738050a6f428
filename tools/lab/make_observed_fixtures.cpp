// Makes models of scenes with known geometry: fixtures/air and fixtures/room, like COLMAP's models
// without photographs; fixtures/dense_room, the room from dense stereo; and fixtures/scanned_room,
// the room from laser scanners. Usage: make_observed_fixtures FOLDER
#include "observed/observe.h"
#include "observed/scan.h"
#include "observed/write_model.h"
#include "run_program.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

namespace {

using vcarve::observed::ObservedModel;
using vcarve::observed::ObservedScene;

void make(const std::filesystem::path& folder, const ObservedScene& observed)
{
    const ObservedModel model = vcarve::observed::observe(observed);
    write_model(folder, model);
    write_truth(folder, observed);
    fmt::print("{}: {} points, {} views, {} rays, {} true faces\n", observed.name,
               model.scene.num_points(), model.scene.views.size(), model.scene.num_rays(),
               observed.parts.mesh.faces.size());
}

void make_dense(const std::filesystem::path& folder, const ObservedScene& observed)
{
    constexpr std::size_t kPoints = 8000;
    constexpr double kStep = 1e-4; // hides differences in the last bits of sine and cosine
    const vcarve::Scene scene = vcarve::observed::observe_densely(observed, kPoints);
    vcarve::observed::write_workspace(folder, scene, kStep);
    fmt::print("dense_{}: {} points, {} views, {} rays\n", observed.name, scene.num_points(),
               scene.views.size(), scene.num_rays());
}

/// Scans the room from four tripods around its center.
void make_scan(const std::filesystem::path& folder, const ObservedScene& observed)
{
    constexpr std::size_t kPointsAScan = 2500;
    constexpr double kStep = 1e-4;
    std::vector<vcarve::observed::Beam> beams;
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(-1.2, -1.3, 1.5), Eigen::Vector3d(1.9, -0.7, 1.4),
          Eigen::Vector3d(0.1, 1.5, 1.6), Eigen::Vector3d(-0.2, 0.4, 1.2)}) {
        const auto more = vcarve::observed::tripod_beams(place, kPointsAScan);
        beams.insert(beams.end(), more.begin(), more.end());
    }
    const vcarve::observed::Scan scan = vcarve::observed::scan(observed.parts.mesh, beams);
    std::filesystem::create_directories(folder);
    vcarve::observed::write_scan(folder / "scan.ply", scan, kStep);
    fmt::print("scanned_{}: {} points\n", observed.name, scan.positions.size());
}

} // namespace

int main(int argc, char** argv)
{
    return vcarve::run_program(std::span(argv, static_cast<std::size_t>(argc)),
                               "make_observed_fixtures FOLDER", 1, 1, [](std::span<char*> words) {
                                   const std::filesystem::path folder = words[0];
                                   const ObservedScene air = vcarve::observed::from_the_air();
                                   const ObservedScene room = vcarve::observed::inside_a_room();
                                   make(folder / air.name, air);
                                   make(folder / room.name, room);
                                   make_dense(folder / "dense_room", room);
                                   make_scan(folder / "scanned_room", room);
                               });
}
