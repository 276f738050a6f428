#pragma once

#include "base/progress.h"
#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The depth maps of all views, and the neighbors that each view is compared with.
struct DepthMaps {
    const std::vector<StereoView>& views;
    const std::vector<DepthMap>& maps; ///< parallel to `views`
    const std::vector<std::vector<std::uint32_t>>& neighbors;
};

/// Fuses pixels on which at least three depth maps agree to points (after J. L. Schoenberger et
/// al., "Pixelwise view selection for unstructured multi-view stereo", ECCV 2016, section 4.5).
/// Pixels agree within 6 pixel sizes of depth, 32 degrees between normals, and 3 pixels of
/// reprojection. A point is their mean, and they start no further point. The result has the cameras
/// and views of `sparse`, tracks, normals and colors; errors are unknown. Cost: O(pixels x
/// neighbors), serial.
Scene fuse(const Scene& sparse, const DepthMaps& depths, const Progress& progress);

} // namespace vcarve
