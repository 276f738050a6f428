#pragma once

#include "io/colmap/scene_builder.h"

#include <filesystem>

namespace vcarve {

/// Read cameras.bin, images.bin and points3D.bin of a folder into a builder, in that order.
void read_binary_files(const std::filesystem::path& folder, SceneBuilder& builder);

/// Read cameras.txt, images.txt and points3D.txt of a folder into a builder, in that order.
void read_text_files(const std::filesystem::path& folder, SceneBuilder& builder);

} // namespace vcarve
