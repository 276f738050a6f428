#pragma once

#include "stereo/patch_match.h"

namespace vcarve {

/// Drops the pixels of connected regions that are smaller than `min_pixels`: of neighbors whose
/// planes differ by less than 1 % in depth. False matches agree with few of their neighbors. Cost:
/// O(pixels).
void drop_speckles(DepthMap& map, int min_pixels);

/// Fills connected plain regions, where the photograph shows nothing to match, with the plane that
/// most measured pixels around them lie in, as the planar prior of Q. Xu and W. Tao, "Planar prior
/// assisted PatchMatch multi-view stereo", AAAI 2020, but per region. A region stays empty if fewer
/// than two in five of the pixels around it agree on a plane within 0.5 % of depth, and so do
/// pixels that do not lie between them, or where the plane is not within 2 % of the depth of the
/// sparse surface: the sky is plain, too. Cost: O(pixels), and 200 samples a region.
void fill_plain_regions(DepthMap& map, const Pinhole& camera,
                        const std::vector<PixelPlane>& surface);

} // namespace vcarve
