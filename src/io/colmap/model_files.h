#pragma once

#include "io/colmap/colmap_model.h"
#include "io/files/mapped_file.h"

#include <array>
#include <filesystem>
#include <string>

namespace vcarve {

/// The stems of the required files of a COLMAP model.
inline constexpr std::array<const char*, 3> kModelFiles{"cameras", "images", "points3D"};

/// Replaces points3D.bin and .txt in the output of some converters.
inline constexpr const char* kPointsPly = "points3D.ply";
/// The file of points in nerfstudio's folder of poses.
inline constexpr const char* kSparsePly = "sparse_pc.ply";

/// The name of a model file: model_file("images", ModelFormat::text) is "images.txt".
inline std::string model_file(const char* stem, ModelFormat format)
{
    return std::string(stem) + (format == ModelFormat::binary ? ".bin" : ".txt");
}

/// The path of a model file. A transforms model is one file, which has the views.
inline std::filesystem::path model_path(const std::filesystem::path& model, const char* stem,
                                        ModelFormat format)
{
    return format == ModelFormat::transforms ? model : model / model_file(stem, format);
}

/// The size of a point without its track in points3D.bin: id, position, color, error, track length.
inline constexpr std::size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;

} // namespace vcarve
