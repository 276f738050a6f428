#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <optional>

namespace vcarve {

/// Of how many keypoints an image's places are counted, about: enough to tell where it has none.
inline constexpr std::size_t kKeypointsCounted = 2048;

/// Counts a keypoint of a view; not one outside its image, whose camera is given.
void count_keypoint(View& view, const Camera& camera, const Eigen::Vector2d& x_px);

/// How densely keypoints lie around a place in a view's image, over the mean of all its image: 1 as
/// anywhere, 0 where there are none, as in the sky. Nothing where the place is not in the image or
/// its keypoints are not known.
std::optional<double> keypoint_density(const View& view, const Camera& camera,
                                       const Eigen::Vector3d& x_in_world);

} // namespace vcarve
