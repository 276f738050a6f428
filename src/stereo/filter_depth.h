#pragma once

#include "stereo/patch_match.h"

namespace vcarve {

/// Drops connected regions of fewer than `min_pixels` pixels. Neighboring pixels are connected if
/// their depths differ by less than 6 pixel sizes. False matches agree with few neighbors. Cost:
/// O(pixels).
void drop_speckles(DepthMap& map, const Pinhole& camera, int min_pixels);

/// Fills connected regions without texture with the plane that most measured pixels around them lie
/// in (after the planar prior of Q. Xu and W. Tao, "Planar prior assisted PatchMatch multi-view
/// stereo", AAAI 2020, but per region). A region stays empty if fewer than two in five of these
/// pixels agree on a plane within 0.5 % of depth. A pixel stays empty if it is not between the
/// agreeing pixels, or if the plane is more than 2 % of depth from the sparse `surface`: the sky
/// has no texture, either. Cost: O(pixels), and 200 samples per region.
void fill_plain_regions(DepthMap& map, const Pinhole& camera,
                        const std::vector<PixelPlane>& surface);

} // namespace vcarve
