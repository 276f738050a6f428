#pragma once

#include "base/progress.h"
#include "cli/command_line.h"
#include "io/images/find_photographs.h"
#include "io/input/find_input.h"
#include "options/option.h"
#include "run/checkpoints.h"
#include "run/job.h"
#include "run/stage_file.h"
#include "stereo/dense_points.h"
#include "vcarve/reconstruct.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace vcarve {

// For checkpoints. Planes are written as they are in memory.
template <>
inline constexpr bool kIsPlain<PixelPlane> = true;
template <>
inline constexpr int kNumFields<DepthMap> = 4;
template <>
inline constexpr int kNumFields<Photograph> = 4;
template <>
inline constexpr int kNumFields<DepthPicture> = 3;
template <>
inline constexpr int kNumFields<DensePoints> = 2;

} // namespace vcarve

namespace vcarve::cli {

/// The options of dense stereo.
struct DenseArguments {
    bool dense = false;
    int size_px = StereoOptions().size_px; ///< longest side of the working images
    std::filesystem::path keep_points;     ///< empty: the fused points are not written
};

/// Default of --max-closing with --dense. Dense points lie close together, so long faces are
/// spurious: with 0.115 faces span streets from roof to roof.
inline constexpr double kDenseClosing = 0.02;

/// --dense, --dense-size and --keep-points, under the heading "Input".
OptionList dense_options(DenseArguments& dense);

/// Throws UsageError if an option needs --dense, or the extension of --keep-points is not .ply.
void check_dense(const DenseArguments& dense, const ParsedArguments& given);

/// The file of visibility beside the PLY file of --keep-points, as COLMAP's stereo_fusion names it.
std::filesystem::path visibility_beside(const std::filesystem::path& cloud);

/// Writes points and their visibility as COLMAP's stereo_fusion does: a view is numbered by its
/// place in the model's file. Throws UsageError if a file cannot be written.
void write_points(const std::filesystem::path& path, const Scene& scene, const FoundModel& model);

/// The photographs as facts of a job: the content of every file in the folder. Cost: reads them.
Job photograph_facts(const std::filesystem::path& folder, const Progress& progress);

/// A run that measures dense points.
struct DenseRun {
    const DenseArguments& arguments;
    const Photographs& photographs;
    std::optional<std::int64_t> most; ///< bytes that may be used; nothing for no limit
    Checkpoints& checkpoints;         ///< depth maps are kept as pieces of "depth"
};

/// Measures dense points from the photographs, starting from the sparse surface. Throws as
/// dense_points() does; InputError if too few photographs can be used, or the memory does not
/// suffice.
DensePoints measure_dense_points(const DenseRun& run, const Reconstruction& sparse);

} // namespace vcarve::cli
