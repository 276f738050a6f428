#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace vcarve {

/// A cloud whose visibility is read: how many points it has, and its path for the messages.
struct CloudSize {
    std::uint64_t num_points = 0;
    std::filesystem::path path;
};

/// Reads which views saw which point of a cloud from the file COLMAP's stereo_fusion writes beside
/// it: how many points there are (uint64), then for each of them a count and as many numbers of
/// images (uint32), which count the images as they stand in their file. `file_order` turns them
/// into numbers of views; a view that a point names twice counts once. Throws InputError naming the
/// place: the file is missing or cut off, has bytes left over, tells of more or fewer points than
/// the cloud has, or of an image that is not there; and Cancelled. Cost: linear in the size of the
/// file, in parallel but for one pass that finds where points begin; what it allocates is sized by
/// the bytes that are there.
Tracks read_visibility(const std::filesystem::path& path, const CloudSize& cloud,
                       std::span<const std::uint32_t> file_order, const Progress& progress = {});

} // namespace vcarve
