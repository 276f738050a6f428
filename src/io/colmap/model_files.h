#pragma once

#include "io/colmap/colmap_model.h"

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

namespace vcarve {

/// The files a COLMAP model cannot do without, by their names before the dot.
inline constexpr std::array<const char*, 3> kModelFiles{"cameras", "images", "points3D"};

/// What may stand for points3D beside the others, as converters write it.
inline constexpr const char* kPointsPly = "points3D.ply";
/// nerfstudio's poses and, beside them, their points.
inline constexpr const char* kTransforms = "transforms.json";
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

/// Whether there is a file, or a folder, that links lead to; what cannot be asked is none.
inline bool is_file(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

inline bool is_folder(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_directory(path, error);
}

} // namespace vcarve
