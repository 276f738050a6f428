#pragma once

#include "cli/command_line.h"
#include "io/images/find_photographs.h"
#include "options/option.h"
#include "vcarve/log.h"
#include "vcarve/reconstruct.h"
#include "vcarve/scene.h"

#include <filesystem>

namespace vcarve::cli {

/// The options of dense stereo.
struct DenseArguments {
    bool dense = false;
    int size_px = 640;                 ///< longest side of the working images
    std::filesystem::path keep_points; ///< empty: the fused points are not written
};

/// --dense, --dense-size and --keep-points, under the heading "Input".
OptionList dense_options(DenseArguments& dense);

/// Throws UsageError if an option needs --dense, or the extension of --keep-points is not .ply.
void check_dense(const DenseArguments& dense, const ParsedArguments& given);

/// The file of visibility beside the PLY file of --keep-points, as COLMAP's stereo_fusion names it.
std::filesystem::path visibility_beside(const std::filesystem::path& cloud);

/// Measures dense points from the photographs, starting from the sparse surface, and writes them if
/// --keep-points says so. Throws as dense_points() does; UsageError if no photograph can be used.
Scene measure_dense_points(const DenseArguments& arguments, const Reconstruction& sparse,
                           const Photographs& photographs, Log& log);

} // namespace vcarve::cli
