#pragma once

#include "stereo/stereo_view.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Chooses the views that each view is matched with: at most `most` indices into `views`, best
/// first. Each common point of two views scores by the angle between its rays: 1 from 3 to 25
/// degrees, less outside (after the view selection of J. L. Schoenberger et al., "Pixelwise view
/// selection for unstructured multi-view stereo", ECCV 2016). Views with a score of at most 5 are
/// not chosen. Cost: O(sum of squared track lengths); long tracks are subsampled.
std::vector<std::vector<std::uint32_t>>
choose_sources(const Scene& scene, const std::vector<StereoView>& views, std::size_t most);

} // namespace vcarve
