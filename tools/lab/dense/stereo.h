#pragma once

#include "render/photo_scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve::dense {

/// How a stereo matcher errs.
struct StereoNoise {
    double smooth_px = 0.35; ///< standard deviation of the disparity, alike in a window of 5 x 5
    double rough_px = 0.15;  ///< the same, of each pixel by itself
    double normal_deg = 8.0; ///< standard deviation of the normals' two angles
    double outliers = 0.02;  ///< share of pixels that are matched somewhere else
    double most_slant_deg =
        78.0; ///< surfaces seen at a larger angle from their normal have no depth
};

/// What stereo finds of a view, a pixel after the other, row by row.
struct DepthMap {
    std::vector<double> depths;           ///< along the camera's z; 0 where there is none
    std::vector<Eigen::Vector3d> normals; ///< unit, towards the view
    std::vector<std::array<std::uint8_t, 3>> colors;
};

/// The depth map of view number `view` of a scene: the true depths with errors of the matcher,
/// which grow with the square of the depth over focal length times baseline (the distance to the
/// sixth nearest view). Pixels beside a jump of the depth have none, since windows hold both sides
/// there. The same for the same seed and view. Cost: a rendering of the scene.
DepthMap stereo_depths(const render::PhotoScene& scene, std::size_t view, const StereoNoise& noise,
                       std::uint64_t seed);

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
