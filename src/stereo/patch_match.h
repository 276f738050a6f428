#pragma once

#include "stereo/patch.h"
#include "stereo/stereo_view.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace vcarve {

/// Depth and normal per pixel of a view, kDepthStep pixels of its image apart.
struct DepthMap {
    static constexpr float kNoCost = 2.0F; ///< and above: nothing was measured
    static constexpr float kPlain = 3.0F;  ///< nothing to match: the photograph shows no texture
    static constexpr float kFilled = 0.3F; ///< a plain pixel that was given a plane

    int width_px = 0;
    int height_px = 0;
    std::vector<PixelPlane> planes;
    std::vector<float> costs; ///< below kNoCost where there is a plane

    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_px + x; }
    bool is_measured(std::size_t pixel) const { return costs[pixel] < kNoCost; }
    bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
};

/// A depth map of the size of an image, without planes.
DepthMap empty_depth_map(const GrayImage& image);

/// What is known of a view before it is matched.
struct DepthPrior {
    float nearest = 0.0F; ///< range of depths
    float farthest = 0.0F;
    std::vector<PixelPlane> surface; ///< per pixel of the depth map: the sparse surface, if any
};

/// Depth of a view by PatchMatch (M. Bleyer et al., "PatchMatch stereo", BMVC 2011), from coarse to
/// fine (Q. Xu and W. Tao, "Multi-scale geometric consistency guided multi-view stereo", CVPR
/// 2019). Starts from the prior; where there is none, from random depths. The cost of a plane is
/// the mean of the two best source views. Random numbers depend on `view.view` only, so the result
/// is the same for any thread count. Cost: about 40 plane evaluations a pixel.
DepthMap match_view(const StereoView& view, std::span<const StereoView* const> sources,
                    const DepthPrior& prior);

} // namespace vcarve
