#pragma once

#include "base/progress.h"
#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The depth maps of all views, and the views that each is compared with.
struct DepthMaps {
    const std::vector<StereoView>& views;
    const std::vector<DepthMap>& maps; ///< parallel to `views`
    const std::vector<std::vector<std::uint32_t>>& neighbors;
};

/// Points on which at least three depth maps agree (after J. L. Schoenberger et al., "Pixelwise
/// view selection for unstructured multi-view stereo", ECCV 2016, section 4.5): depths within 1 %,
/// normals within 32 degrees, reprojection within 3 pixels. Each is the mean of what agrees, whose
/// pixels are used up. The result has the cameras and views of `sparse`, tracks of the views that
/// agree, normals and colors; errors are unknown. Cost: O(pixels x neighbors), on one thread.
Scene fuse(const Scene& sparse, const DepthMaps& depths, const Progress& progress);

} // namespace vcarve
