#include "cli/dense_run.h"

#include "base/parallel.h"
#include "base/text.h"
#include "io/colmap/colmap_model.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "model/camera.h"
#include "texture/texture_mesh.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <system_error>
#include <vector>

namespace vcarve::cli {

namespace fs = std::filesystem;

namespace {

void require_stereo_memory(const DenseRun& run, const std::vector<CalibratedPhoto>& photos)
{
    const std::int64_t needed =
        predicted_stereo_memory(photos, {run.arguments.size_px}, num_threads());
    if (!run.limit || needed <= *run.limit) return;
    throw InputError(fmt::format("--dense needs about {} of memory for {} photographs, but the "
                                 "limit is {}; use a smaller --dense-size, fewer --threads, or a "
                                 "larger --max-memory",
                                 byte_size_text(needed), photos.size(),
                                 byte_size_text(*run.limit)));
}

} // namespace

OptionList dense_options(DenseArguments& dense)
{
    constexpr const char* kStage = "Dense stereo";
    return {
        {kStage,
         {.name = "dense",
          .help = "Compute dense points from photographs. The photographs are in "
                  "--images, or in the folder `images` beside the model."},
         &dense.dense},
        {kStage,
         {.name = "dense-size",
          .unit = "px",
          .help = "Scale the longest side of photographs to N pixels for matching. Depth is "
                  "measured at every second pixel; time grows with the square of N.",
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
    if (dense.dense && given.has("points")) {
        throw UsageError("--dense and --points both supply dense points; remove one of them");
    }
    if (!dense.keep_points.empty() && lower_case_end(dense.keep_points) != ".ply") {
        throw UsageError(
            fmt::format("cannot write {}: --keep-points needs .ply", dense.keep_points.string()));
    }
}

fs::path visibility_beside(const fs::path& cloud)
{
    return cloud.string() + ".vis";
}

void write_points(const fs::path& path, const Scene& scene, const FoundModel& model)
{
    TriMesh points;
    points.positions = scene.positions;
    points.colors = scene.colors;
    points.normals = scene.normals;
    points.offset = scene.offset;
    write_mesh(path, points, {});
    const std::vector<std::uint32_t> order =
        read_colmap_views(model.folder, model.format).file_order;
    std::vector<std::uint32_t> number_of_view(scene.views.size());
    for (std::uint32_t number = 0; number < order.size(); ++number) {
        number_of_view[order[number]] = number;
    }
    OutputFile file(visibility_beside(path));
    const auto put = [&](const auto value) {
        file.stream().write(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(static_cast<std::uint64_t>(scene.num_points()));
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        const auto track = scene.tracks[point];
        put(static_cast<std::uint32_t>(track.size()));
        for (const std::uint32_t view : track) {
            put(number_of_view[view]);
        }
    }
    file.commit();
}

Job photograph_facts(const fs::path& folder, const Progress& progress)
{
    std::vector<fs::path> files;
    std::error_code error; // a missing folder is reported later
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    Job facts;
    for (const fs::path& file : files) {
        facts.push_back(file_fact("photograph " + file.lexically_relative(folder).string(), file));
        progress.report(static_cast<double>(facts.size()), static_cast<double>(files.size()));
    }
    return facts;
}

/// Returns make(), or its result of an earlier run if the folder has it intact.
DepthMap kept_depth(const WorkFolder* work, const std::string& name,
                    const std::function<DepthMap()>& make)
{
    if (work == nullptr) return make();
    try {
        DepthMap kept;
        if (work->has(name)) {
            work->load(name, kept);
            return kept;
        }
    } catch (const InputError&) { // damaged; make() computes the same bytes again
    }
    DepthMap made = make();
    work->save(name, made);
    return made;
}

DensePoints measure_dense_points(const DenseRun& run, const Reconstruction& sparse)
{
    std::vector<CalibratedPhoto> photos =
        calibrated_photos(sparse.scene, run.photographs, sparse.scene.offset);
    std::erase_if(photos, [](const CalibratedPhoto& photo) { return !intrinsics(photo.camera); });
    if (photos.size() < 3) {
        throw InputError(fmt::format("{}: --dense needs at least 3 photographs of views with a "
                                     "known, non-spherical lens, but found {}; name their folder "
                                     "with --images",
                                     run.photographs.folder.string(), photos.size()));
    }
    require_stereo_memory(run, photos);
    const auto keep = [&](std::size_t photo, const std::function<DepthMap()>& make) {
        return kept_depth(run.work, fmt::format("depth-{}-of-{}", photo, photos.size()), make);
    };
    return dense_points(sparse, photos, {run.arguments.size_px}, keep, run.log);
}

} // namespace vcarve::cli
