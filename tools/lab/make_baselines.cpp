// Makes the baselines of strict carving: the alpha shape and the sculpture of a model's points.
// Usage: make_baselines MODEL FOLDER [ALPHA]. ALPHA is a multiple of the smallest alpha that keeps
// all points and one component, by default 1. Writes FOLDER/alpha_shape.ply and
// FOLDER/sculpture.ply; FOLDER must exist.
#include "baselines/baseline_surface.h"
#include "run_program.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>

int main(int argc, char** argv)
{
    return vcarve::run_program(
        std::span(argv, static_cast<std::size_t>(argc)), "make_baselines MODEL FOLDER [ALPHA]", 2,
        3, [](std::span<char*> words) {
            vcarve::Log log;
            const vcarve::Scene scene = vcarve::read_model(words[0], log);
            const std::filesystem::path folder = words[1];
            const double alpha = words.size() == 3 ? std::stod(words[2]) : 1.0;
            using vcarve::Baseline;
            vcarve::write_ply(folder / "alpha_shape.ply",
                              vcarve::baseline_surface(scene, Baseline::alpha_shape, alpha), {});
            vcarve::write_ply(folder / "sculpture.ply",
                              vcarve::baseline_surface(scene, Baseline::sculpture), {});
        });
}
