// Makes what strict carving is held against: the alpha shape and the sculpture of a model's points.
// Usage: make_baselines MODEL FOLDER [ALPHA], where ALPHA is a multiple of the smallest alpha that
// keeps all points and one piece, by default 1. Writes FOLDER/alpha_shape.ply and
// FOLDER/sculpture.ply; FOLDER must exist.
#include "baselines/baseline_surface.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

int main(int argc, char** argv)
try {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: make_baselines MODEL FOLDER [ALPHA]\n");
        return 2;
    }
    vcarve::Log log;
    const vcarve::Scene scene = vcarve::read_model(argv[1], log);
    const std::filesystem::path folder = argv[2];
    const double alpha = argc == 4 ? std::stod(argv[3]) : 1.0;
    using vcarve::Baseline;
    vcarve::write_ply(folder / "alpha_shape.ply",
                      vcarve::baseline_surface(scene, Baseline::alpha_shape, alpha), {});
    vcarve::write_ply(folder / "sculpture.ply",
                      vcarve::baseline_surface(scene, Baseline::sculpture), {});
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "make_baselines: {}\n", error.what());
    return 1;
}
