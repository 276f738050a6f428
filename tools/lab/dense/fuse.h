#pragma once

#include "dense/stereo.h"

#include <cstdint>
#include <vector>

namespace vcarve::dense {

/// When depths of several views are one point.
struct FuseOptions {
    std::size_t least_views = 3;
    double most_depth_error = 0.01;   ///< share of the depth
    double most_place_error_px = 2.0; ///< where a point of another view is met again
};

/// A fused cloud and the views that each of its points was found in, ascending.
struct FusedCloud {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> normals;
    std::vector<std::array<std::uint8_t, 3>> colors;
    std::vector<std::vector<std::uint32_t>> views;
};

/// Fuses depth maps as COLMAP's stereo_fusion does: each pixel that is not yet part of a point
/// looks for pixels of other views whose depth agrees with its own; where enough are found their
/// medians make a point. Cost: O(pixels x views that overlap).
FusedCloud fuse(const std::vector<render::Pinhole>& views, std::vector<DepthMap> maps,
                const FuseOptions& options);

} // namespace vcarve::dense
