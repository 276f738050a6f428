#pragma once

#include "stereo/stereo_view.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Chooses the views that each view is matched with, best first: indices into `views`, at most
/// `most`. A view scores for each point that both see, by the angle between the two rays: most
/// between 3 and 25 degrees, less outside (after the view selection of J. L. Schoenberger et al.,
/// "Pixelwise view selection for unstructured multi-view stereo", ECCV 2016). Views that share
/// fewer than five good points are no neighbors. Cost: O(sum of squared track lengths), of long
/// tracks some views only.
std::vector<std::vector<std::uint32_t>>
choose_sources(const Scene& scene, const std::vector<StereoView>& views, std::size_t most);

} // namespace vcarve
