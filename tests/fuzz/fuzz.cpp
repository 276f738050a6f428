// The targets of tools/ci/fuzz: every reader, and a whole run.
// An input consists of the files of a model, separated by kNext. An input may be rejected.
// Crashes, hangs, excessive memory and all other exceptions are findings.
#include "io/colmap/sim3_text.h"
#include "io/images/read_photograph.h"
#include "pipeline/run_state.h"
#include "region/region.h"
#include "run/stage_file.h"
#include "tiles/tile_surface.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNext = "\n<next file>\n";

/// The folder for the files of an input; in memory if the system has such a file system.
const fs::path& folder()
{
    static const fs::path made = [] {
        const fs::path parent = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
        const fs::path own = parent / ("vcarve-fuzz-" + std::to_string(::getpid()));
        std::atexit([] { fs::remove_all(folder()); });
        return own;
    }();
    return made;
}

/// Writes the files of the input; there may be fewer than names.
void put(std::string_view input, const std::vector<const char*>& names)
{
    fs::remove_all(folder());
    fs::create_directories(folder() / "sparse");
    for (const char* const name : names) {
        const std::size_t end = std::min(input.find(kNext), input.size());
        std::ofstream(folder() / name, std::ios::binary) << input.substr(0, end);
        if (end == input.size()) return;
        input.remove_prefix(end + kNext.size());
    }
}

void read_as_model(const fs::path& path, const PointsOptions& options = {})
{
    Log silent;
    read_model(path, options, silent);
}

void read_binary(std::string_view input)
{
    put(input, {"cameras.bin", "images.bin", "points3D.bin"});
    read_as_model(folder());
}

void read_text(std::string_view input)
{
    put(input, {"cameras.txt", "images.txt", "points3D.txt"});
    read_as_model(folder());
}

void read_cloud(std::string_view input)
{
    put(input, {"sparse/cameras.txt", "sparse/images.txt", "fused.ply", "fused.ply.vis",
                "sparse/points3D.txt"});
    std::ofstream(folder() / "sparse/points3D.txt", std::ios::app);
    read_as_model(folder(), {.points = "dense"});
}

void read_scan(std::string_view input)
{
    put(input, {"scan.ply"});
    read_as_model(folder() / "scan.ply");
}

void read_transforms(std::string_view input)
{
    put(input, {"transforms.json", "points3D.ply"});
    read_as_model(folder() / "transforms.json");
}

void read_mesh(std::string_view input)
{
    put(input, {"mesh.ply"});
    read_ply(folder() / "mesh.ply");
}

void read_region(std::string_view input)
{
    const bool is_mesh = input.starts_with("ply");
    put(input, {is_mesh ? "region.ply" : "region.json"});
    RegionChoice choice;
    choice.kind = RegionChoice::Kind::file;
    choice.file = (folder() / (is_mesh ? "region.ply" : "region.json")).string();
    make_region(choice, Scene());
}

void read_transformation(std::string_view input)
{
    put(input, {"sim3.txt"});
    read_sim3(folder() / "sim3.txt");
}

void read_image(std::string_view input)
{
    put(input, {"photo"});
    const PhotographSize size = photograph_size(folder() / "photo");
    constexpr double kManyPixels = 1e6; // a larger array is no fault
    if (static_cast<double>(size.width_px) * size.height_px > kManyPixels) return;
    read_photograph(folder() / "photo");
}

template <typename Noun>
void read_stage_as(const fs::path& path)
{
    Noun noun{};
    StageReader reader(path, {"cells", {}});
    reader.get(noun);
    reader.finish();
}

/// The first byte selects the expected content, and whether the rest is the content of a stage file
/// with correct digests (even) or the whole file (odd).
void read_stage(std::string_view input)
{
    if (input.empty()) return;
    const unsigned first = static_cast<unsigned char>(input[0]);
    input.remove_prefix(1);
    fs::create_directories(folder());
    const fs::path path = folder() / "cells.stage";
    if (first % 2 == 1) {
        std::ofstream(path, std::ios::binary) << input;
    } else {
        StageWriter writer(path, {"cells", {}}, input.size());
        for (const char byte : input) {
            writer.put(byte);
        }
        writer.commit();
    }
    if (first / 2 % 2 == 0) return read_stage_as<Scene>(path);
    return read_stage_as<TileSurface>(path);
}

void run(std::string_view input)
{
    put(input, {"cameras.txt", "images.txt", "points3D.txt"});
    Log silent;
    Options options;
    options.threads = 1;
    // The first character of the input selects the options.
    options.surface.closed = input.starts_with("2");
    if (input.starts_with("3")) options.labels.method = Method::strict;
    if (input.starts_with("4")) options.refine.smooth.iterations = 2;
    reconstruct(folder(), {}, options, silent);
}

const std::map<std::string_view, void (*)(std::string_view)>& targets()
{
    static const std::map<std::string_view, void (*)(std::string_view)> all = {
        {"binary", read_binary},
        {"text", read_text},
        {"cloud", read_cloud},
        {"scan", read_scan},
        {"mesh", read_mesh},
        {"transforms", read_transforms},
        {"region", read_region},
        {"transformation", read_transformation},
        {"stage", read_stage},
        {"image", read_image},
        {"run", run}};
    return all;
}

} // namespace
} // namespace vcarve

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const auto target = [] {
        const char* const name = std::getenv("VCARVE_FUZZ");
        const auto& all = vcarve::targets();
        const auto found = all.find(name == nullptr ? "" : name);
        if (found == all.end()) {
            std::fputs("set VCARVE_FUZZ to a target of tests/fuzz/fuzz.cpp\n", stderr);
            std::_Exit(2);
        }
        return found->second;
    }();
    try {
        target({reinterpret_cast<const char*>(data), size});
    } catch (const vcarve::InputError&) {
    } catch (const vcarve::UsageError&) {
    }
    return 0;
}
