#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vcarve {

/// How uncertain a point is if its place in each image is in error by one pixel, in squares of
/// scene units: its sights meet in an ellipsoid that is long where they meet at small angles
/// (covariance by backward propagation, Hartley & Zisserman 2004, 5.2). Zero where they do not
/// cross. Of a scanner's sight the range is in error, too, by as much as a pixel covers there.
/// `focals_px` are mean_focals_px() of the cameras. Cost: O(sights of the point).
Eigen::Matrix3d covariance_of_a_pixel(const Scene& scene, std::size_t point,
                                      const std::vector<double>& focals_px);

} // namespace vcarve
