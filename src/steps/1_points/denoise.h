#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// How noisy points were and what was done about it.
struct DenoiseReport {
    std::int64_t moved = 0; ///< points
    double noise_px = 0.0;  ///< standard deviation of a point's places in the images
};

/// Moves points within their own uncertainty to the surface that the points around agree on. How
/// uncertain a point is in which direction, its sights tell: their rays, each in error by the same
/// number of pixels, meet in an ellipsoid that is long where they meet at small angles (covariance
/// by backward propagation, Hartley & Zisserman 2004, 5.2). How many pixels, the cloud tells: the
/// median height of points above the planes of those around, over what one pixel makes of it.
///
/// A plane lies through each of the 12 nearest points, across its normal; of the 24 nearest where
/// normals are missing or the noise is two fifths of the distance between points or more. Normals
/// are the cloud's, or where it has none those of planes fitted to the points around (Hoppe et al.
/// 1992), and are filtered once with weights by nearness and likeness (Jones, Durand & Zwicker
/// 2004). The planes
/// of near points with a like normal, of which the point lies within `denoise` standard deviations,
/// are taken together by their uncertainty, and so is the point with them; it moves by no more than
/// `denoise` of its own standard deviations. (The bilateral filter of Fleishman, Drori & Cohen-Or
/// 2003, with variances known.)
///
/// Points whose reprojection error is known stay, since a matcher found them one by one, and so do
/// those whose sights do not cross, and all of a scan whose noise is less than 8 % of the distance
/// between points, in the median. Normals of the scene stay as they are. Points are finite and no
/// two at one place, before and after. The result is the same for any number of threads and any
/// scale of the scene. Cost: O(points log points + sights), in parallel but for a k-d tree; 200
/// bytes a point, 250 without normals.
DenoiseReport denoise_points(Scene& scene, const DenoiseOptions& options,
                             const Progress& progress = {});

/// Puts points that came to one place back to where they were before, until no two are at one.
/// Cost: a parallel sort each time.
void keep_apart(std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3d>& before);

} // namespace vcarve
