#pragma once

#include "base/progress.h"
#include "cli/command_line.h"
#include "io/images/find_photographs.h"
#include "io/input/find_input.h"
#include "options/option.h"
#include "run/job.h"
#include "run/stage_file.h"
#include "run/work_folder.h"
#include "stereo/dense_points.h"
#include "vcarve/reconstruct.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace vcarve {

// Depth maps are kept in files. Planes are written as in memory.
template <>
inline constexpr bool kIsPlain<PixelPlane> = true;
template <>
inline constexpr int kNumFields<DepthMap> = 4;

} // namespace vcarve

namespace vcarve::cli {

/// The options of dense stereo.
struct DenseArguments {
    bool dense = false;
    int size_px = StereoOptions().size_px; ///< longest side of the working images
    std::filesystem::path keep_points;     ///< empty if the fused points are not written
};

/// Default of --max-closing with --dense. Dense points lie close together, so long faces are
/// spurious: with 0.115 faces span streets from roof to roof.
inline constexpr double kDenseClosing = 0.02;

/// --dense, --dense-size and --keep-points, under the heading "Dense stereo".
OptionList dense_options(DenseArguments& dense);

/// Throws UsageError if an option needs --dense, or the extension of --keep-points is not .ply.
void check_dense(const DenseArguments& dense, const ParsedArguments& given);

/// The file of visibility beside the PLY file of --keep-points, as COLMAP's stereo_fusion names it.
std::filesystem::path visibility_beside(const std::filesystem::path& cloud);

/// Writes points and their visibility as COLMAP's stereo_fusion does: views are numbered by their
/// order in the model's file. Throws UsageError if a file cannot be written.
void write_points(const std::filesystem::path& path, const Scene& scene, const FoundModel& model);

/// The job's facts about photographs: the content of every file in the folder. Cost: reads them.
Job photograph_facts(const std::filesystem::path& folder, const Progress& progress);

/// A run that measures dense points.
struct DenseRun {
    const DenseArguments& arguments;
    const Photographs& photographs;
    std::optional<std::int64_t> limit; ///< memory limit in bytes; nothing if unlimited
    const WorkFolder* work;            ///< keeps depth maps; null keeps none
    Log& log;
};

/// Measures dense points from the photographs, starting from the sparse surface. Throws InputError
/// if fewer than 3 photographs are usable or the memory is insufficient, and as dense_points().
DensePoints measure_dense_points(const DenseRun& run, const Reconstruction& sparse);

} // namespace vcarve::cli
