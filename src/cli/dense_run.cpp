#include "cli/dense_run.h"

#include "base/text.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "stereo/dense_points.h"
#include "texture/texture_mesh.h"
#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve::cli {

namespace fs = std::filesystem;

namespace {

/// Writes the points as stereo_fusion does: the views of a point are counted in the order of the
/// model's images.
void write_points(const fs::path& path, const Scene& scene)
{
    TriMesh points;
    points.positions = scene.positions;
    points.colors = scene.colors;
    points.normals = scene.normals;
    points.offset = scene.offset;
    write_mesh(path, points, {});
    OutputFile file(visibility_beside(path));
    const auto put = [&](const auto value) {
        file.stream().write(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(static_cast<std::uint64_t>(scene.num_points()));
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        const auto track = scene.tracks[point];
        put(static_cast<std::uint32_t>(track.size()));
        for (const std::uint32_t view : track) {
            put(view);
        }
    }
    file.commit();
}

} // namespace

OptionList dense_options(DenseArguments& dense)
{
    constexpr const char* kStage = "Dense stereo";
    return {
        {kStage,
         {.name = "dense",
          .help = "Measure dense points from the photographs first, on the CPU. They are those of "
                  "--images, or of the folder `images` beside the model."},
         &dense.dense},
        {kStage,
         {.name = "dense-size",
          .unit = "px",
          .help = "Match photographs whose longest side is scaled to N pixels. Depth is measured "
                  "at every second pixel; time grows with the square.",
          .min = 100,
          .max = 10000,
          .level = OptionLevel::advanced},
         &dense.size_px},
        {kStage,
         {.name = "keep-points",
          .unit = "file",
          .help = "Write the dense points to FILE.ply and their views to FILE.ply.vis, as COLMAP's "
                  "stereo_fusion does.",
          .level = OptionLevel::advanced},
         &dense.keep_points},
    };
}

void check_dense(const DenseArguments& dense, const ParsedArguments& given)
{
    for (const char* const name : {"dense-size", "keep-points"}) {
        if (given.has(name) && !dense.dense) {
            throw UsageError(fmt::format("--{} needs --dense", name));
        }
    }
    if (!dense.keep_points.empty() && lower_case_end(dense.keep_points) != ".ply") {
        throw UsageError(
            fmt::format("cannot write {}: --keep-points writes .ply", dense.keep_points.string()));
    }
}

fs::path visibility_beside(const fs::path& cloud)
{
    return cloud.string() + ".vis";
}

Scene measure_dense_points(const DenseArguments& arguments, const Reconstruction& sparse,
                           const Photographs& photographs, Log& log)
{
    const std::vector<CalibratedPhoto> photos =
        calibrated_photos(sparse.scene, photographs, sparse.scene.offset);
    Scene dense = dense_points(sparse.scene, sparse.mesh, photos, {arguments.size_px}, log);
    if (!arguments.keep_points.empty()) write_points(arguments.keep_points, dense);
    return dense;
}

} // namespace vcarve::cli
