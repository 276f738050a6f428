#pragma once

#include "stereo/patch_match.h"

namespace vcarve {

/// Drops the pixels of connected regions that are smaller than `min_pixels`: of neighbors whose
/// planes differ by less than 1 % in depth. False matches agree with few of their neighbors. Cost:
/// O(pixels).
void drop_speckles(DepthMap& map, int min_pixels);

} // namespace vcarve
