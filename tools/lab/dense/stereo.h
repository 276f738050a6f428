#pragma once

#include "render/photo_scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve::dense {

/// Errors of a stereo matcher.
struct StereoNoise {
    double smooth_px = 0.35; ///< standard deviation of the disparity, smooth over 5 x 5 pixels
    double rough_px = 0.15;  ///< the same, independent for each pixel
    double normal_deg = 8.0; ///< standard deviation of the normals' two angles
    double outliers = 0.02;  ///< share of wrongly matched pixels
    double most_slant_deg =
        78.0; ///< no depth if the angle between ray and surface normal is larger
};

/// The result of stereo for a view, row by row.
struct DepthMap {
    std::vector<double> depths;           ///< along the camera's z; 0 if unknown
    std::vector<Eigen::Vector3d> normals; ///< unit, towards the view
    std::vector<std::array<std::uint8_t, 3>> colors;
};

/// The depth map of view `view` of a scene: true depths plus errors of the matcher. Errors are
/// proportional to depth² / (focal length · baseline), where the baseline is the distance to the
/// sixth nearest view. Pixels beside a depth discontinuity have no depth, because windows contain
/// both sides. Depends only on seed and view. Cost: a rendering of the scene.
DepthMap stereo_depths(const render::PhotoScene& scene, std::size_t view, const StereoNoise& noise,
                       std::uint64_t seed);

/// Conditions for merging depths of several views.
struct FuseOptions {
    std::size_t least_views = 3;
    double most_depth_error = 0.01;   ///< as a share of the depth
    double most_place_error_px = 2.0; ///< after projection into another view and back
};

/// A fused cloud, and the views of each point in ascending order.
struct FusedCloud {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> normals;
    std::vector<std::array<std::uint8_t, 3>> colors;
    std::vector<std::vector<std::uint32_t>> views;
};

/// Fuses depth maps like COLMAP's stereo_fusion. Each unused pixel searches for pixels of other
/// views with the same depth. If there are enough, their medians become a point. Cost: O(pixels x
/// overlapping views).
FusedCloud fuse(const std::vector<render::Pinhole>& views, std::vector<DepthMap> maps,
                const FuseOptions& options);

} // namespace vcarve::dense
