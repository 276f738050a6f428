#pragma once

#include "model/similarity.h"

#include <filesystem>

namespace vcarve {

/// The points that a transforms.json of nerfstudio names as `ply_file_path`, or those that lie
/// beside it under a name of nerfstudio's or COLMAP's; empty where there are none. Throws
/// InputError where the file is no such file.
std::filesystem::path points_of_transforms(const std::filesystem::path& file);

/// Reads nerfstudio's dataparser_transforms.json: x' = scale * transform * x leads from the frame
/// of the COLMAP model to that of training. With `poses`, a transforms.json, it leads from the
/// frame of that, so its `applied_transform` is undone. Throws InputError where a file is no such
/// file.
Similarity read_nerfstudio_transform(const std::filesystem::path& file,
                                     const std::filesystem::path& poses);

} // namespace vcarve
