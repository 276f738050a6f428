#pragma once

#include "model/scene_check.h"
#include "vcarve/options.h"

#include <cstddef>
#include <cstdint>

namespace vcarve {

/// The maximum number of points of a tile, so that a run in tiles needs at most `most` bytes: a
/// thousand times a power of two, so that it rarely changes with free memory. Does not depend on
/// the number of threads. Throws InputError if the memory is insufficient.
std::size_t points_of_tile(const SceneSize& model, const Options& options, std::int64_t most);

/// The number of points that a witness represents. There are enough witnesses to prove free space
/// in far tiles, and few enough to be read by each tile.
std::size_t points_of_witness(std::size_t points);

} // namespace vcarve
