#pragma once

#include "model/photograph.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

struct DepthMap;
struct StereoView;

/// A depth map beside its photograph, both of the depth map's size.
struct DepthPicture {
    std::uint32_t view = 0; ///< index into Scene::views
    Photograph photograph;
    Photograph depth; ///< light is near, dark is far, blue was not measured
};

/// The picture of a depth map. Gray is linear in inverse depth, from the nearest to the farthest
/// two in a hundred pixels. Cost: O(pixels log pixels).
DepthPicture depth_picture(const StereoView& view, const DepthMap& map);

/// The number of the depth map with the most measured pixels; 0 if there are none.
std::size_t fullest(const std::vector<DepthMap>& maps);

/// How many pixels have a depth.
std::int64_t num_measured(const DepthMap& map);

} // namespace vcarve
