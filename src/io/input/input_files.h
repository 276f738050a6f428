#pragma once

#include "io/input/find_input.h"

#include <filesystem>
#include <vector>

namespace vcarve {

/// The files that nothing may be written to, since `input` is made of them, read or not: of models
/// in any format, the cloud that was found and what tells of its views, what COLMAP keeps beside
/// (the database, the dense workspace, images). Cost: a look at each file in the folders images and
/// stereo.
std::vector<std::filesystem::path> input_files(const std::filesystem::path& input,
                                               const FoundInput& found);

/// Whether a file is an image of the views that were found, by the end of its path once links are
/// followed. Cost: that of reading the views, where it has the name of an image.
bool is_image_of_views(const std::filesystem::path& file, const FoundInput& found);

} // namespace vcarve
