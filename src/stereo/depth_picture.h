#pragma once

#include "model/photograph.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

struct DepthMap;
struct StereoView;

/// A depth map and its photograph as images of the same size.
struct DepthPicture {
    std::uint32_t view = 0; ///< index into Scene::views
    Photograph photograph;
    Photograph depth; ///< light: near; dark: far; blue: not measured
};

/// Draws a depth map. Gray is linear in inverse depth between its 2nd and 98th percentile. Cost:
/// O(pixels log pixels).
DepthPicture depth_picture(const StereoView& view, const DepthMap& map);

/// The index of the depth map with the most measured pixels; 0 if `maps` is empty.
std::size_t fullest(const std::vector<DepthMap>& maps);

/// The number of pixels with a depth.
std::int64_t num_measured(const DepthMap& map);

} // namespace vcarve
