// Makes fixtures/air and fixtures/room: models of scenes whose geometry is known, as COLMAP would
// reconstruct them, without pictures; and fixtures/dense_room, the room as dense stereo would see
// it. Usage: make_observed_fixtures FOLDER
#include "observed/dense.h"
#include "observed/observe.h"
#include "observed/observed_scene.h"
#include "observed/write_model.h"
#include "observed/write_workspace.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>

namespace {

using vcarve::observed::ObservedModel;
using vcarve::observed::ObservedScene;

void make(const std::filesystem::path& folder, const ObservedScene& observed)
{
    const ObservedModel model = vcarve::observed::observe(observed);
    write_model(folder, model);
    write_truth(folder, observed);
    fmt::print("{}: {} points, {} views, {} sights, {} true faces\n", observed.name,
               model.scene.num_points(), model.scene.views.size(), model.scene.num_sights(),
               observed.parts.mesh.faces.size());
}

void make_dense(const std::filesystem::path& folder, const ObservedScene& observed)
{
    constexpr std::size_t kPoints = 8000;
    constexpr double kStep = 1e-4; // so that the last bits of sine and cosine do not show
    const vcarve::Scene scene = vcarve::observed::observe_densely(observed, kPoints);
    vcarve::observed::write_workspace(folder, scene, kStep);
    fmt::print("dense_{}: {} points, {} views, {} sights\n", observed.name, scene.num_points(),
               scene.views.size(), scene.num_sights());
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        fmt::print(stderr, "usage: make_observed_fixtures FOLDER\n");
        return 2;
    }
    try {
        for (const ObservedScene& observed :
             {vcarve::observed::from_the_air(), vcarve::observed::inside_a_room()}) {
            make(std::filesystem::path(argv[1]) / observed.name, observed);
        }
        make_dense(std::filesystem::path(argv[1]) / "dense_room",
                   vcarve::observed::inside_a_room());
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_observed_fixtures: {}\n", error.what());
        return 1;
    }
    return 0;
}
