#pragma once

#include <filesystem>

namespace vcarve {

/// The points that a transforms.json of nerfstudio names as `ply_file_path`, or those that lie
/// beside it under a name of nerfstudio's or COLMAP's; empty where there are none. Throws
/// InputError where the file is no such file.
std::filesystem::path points_of_transforms(const std::filesystem::path& file);

} // namespace vcarve
