#pragma once

#include "stereo/patch.h"
#include "stereo/stereo_view.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace vcarve {

/// Depth and normal of every kDepthStep-th pixel of a view's image, in both directions.
struct DepthMap {
    static constexpr float kNoCost = 2.0F; ///< from this cost on, a pixel is not measured
    static constexpr float kPlain = 3.0F;  ///< the photograph has no texture to match
    static constexpr float kFilled = 0.3F; ///< set by fill_plain_regions()

    int width_px = 0;
    int height_px = 0;
    std::vector<PixelPlane> planes;
    std::vector<float> costs; ///< below kNoCost if the plane is measured

    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_px + x; }
    bool is_measured(std::size_t pixel) const { return costs[pixel] < kNoCost; }
    bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
};

/// Returns a depth map for an image, without measured pixels.
DepthMap empty_depth_map(const GrayImage& image);

/// Prior knowledge of the depth of a view.
struct DepthPrior {
    float nearest = 0.0F; ///< range of depths
    float farthest = 0.0F;
    std::vector<PixelPlane> surface; ///< sparse surface per pixel of the depth map; or empty
};

/// Computes the depth map of a view by PatchMatch (M. Bleyer et al., "PatchMatch stereo", BMVC
/// 2011), from coarse to fine (Q. Xu and W. Tao, "Multi-scale geometric consistency guided
/// multi-view stereo", CVPR 2019). Starts from the prior, or from random depths without a prior.
/// The cost of a plane is the mean of the two best source views. Random numbers depend on
/// `view.view` only, so threads do not matter. Cost: about 40 plane evaluations per pixel.
DepthMap match_view(const StereoView& view, std::span<const StereoView* const> sources,
                    const DepthPrior& prior);

} // namespace vcarve
