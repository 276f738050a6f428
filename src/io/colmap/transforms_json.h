#pragma once

#include "model/similarity.h"

#include <filesystem>

namespace vcarve {

/// The file of points of a transforms.json: its `ply_file_path`, or else sparse_pc.ply (nerfstudio)
/// or points3D.ply in the same folder. Empty if there is none. Throws InputError if `file` is not a
/// transforms.json.
std::filesystem::path points_of_transforms(const std::filesystem::path& file);

/// Reads nerfstudio's dataparser_transforms.json: x' = scale * transform * x maps the frame of the
/// COLMAP model to the frame of training. If `poses`, a transforms.json, is given, the result
/// maps from the frame of that file, whose `applied_transform` is undone first. Throws InputError
/// if a file has another format.
Similarity read_nerfstudio_transform(const std::filesystem::path& file,
                                     const std::filesystem::path& poses);

} // namespace vcarve
