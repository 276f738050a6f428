#pragma once

#include "io/colmap/colmap_model.h"
#include "io/files/mapped_file.h"

#include <array>
#include <filesystem>
#include <string>

namespace vcarve {

/// The files a COLMAP model cannot do without, by their names before the dot.
inline constexpr std::array<const char*, 3> kModelFiles{"cameras", "images", "points3D"};

/// What may stand for points3D beside the others, as converters write it.
inline constexpr const char* kPointsPly = "points3D.ply";
/// The points beside nerfstudio's poses.
inline constexpr const char* kSparsePly = "sparse_pc.ply";

/// The name of one of them: model_file("images", ModelFormat::text) is "images.txt".
inline std::string model_file(const char* stem, ModelFormat format)
{
    return std::string(stem) + (format == ModelFormat::binary ? ".bin" : ".txt");
}

/// Where one of them is. A model of transforms.json has its views in one file, which it is itself.
inline std::filesystem::path model_path(const std::filesystem::path& model, const char* stem,
                                        ModelFormat format)
{
    return format == ModelFormat::transforms ? model : model / model_file(stem, format);
}

/// The fewest bytes a point takes in points3D.bin: id, position, colour, error, length of the
/// track.
inline constexpr std::size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;

} // namespace vcarve
