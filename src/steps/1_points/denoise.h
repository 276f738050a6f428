#pragma once

#include "base/progress.h"
#include "model/usual_values.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The measured noise and the number of moved points.
struct DenoiseReport {
    std::int64_t moved = 0; ///< points
    double noise_px = 0.0;  ///< standard deviation of the points' image positions, in pixels
};

/// Moves points, within their uncertainty, to the surface that their neighbors agree on. The
/// uncertainty of a point is an ellipsoid that follows from its rays, if each has the same error in
/// pixels. It is long if the rays meet at small angles (covariance by backward propagation, Hartley
/// & Zisserman 2004, 5.2). The error is estimated from the cloud: the median height of points above
/// the planes of their neighbors, over the height that one pixel causes.
///
/// A plane passes through each of the 12 nearest points, perpendicular to its normal. The 24
/// nearest are used if normals are missing or the noise is at least two fifths of the point
/// spacing. Missing normals are those of planes fitted to the neighbors (Hoppe et al. 1992).
/// Normals are filtered once, weighted by distance and similarity (Jones, Durand & Zwicker 2004).
/// The estimate combines the point with the planes of near points with similar normals, weighted by
/// their uncertainty. Planes farther than `denoise` standard deviations count little or not, and
/// the point moves by at most that. (This is the bilateral filter of Fleishman, Drori & Cohen-Or
/// 2003, with known variances.)
///
/// Points whose rays do not cross stay. A scan stays if its median noise is less than 8 % of the
/// point spacing. The normals of the scene are unchanged. The pipeline denoises only dense clouds,
/// since a matcher found the points of sparse models one by one. Points are finite and distinct,
/// before and after. The result is the same for any thread count and scale. Cost: O(points log
/// points + rays), in parallel; 200 bytes per point, 250 without normals.
DenoiseReport denoise_points(Scene& scene, const DenoiseOptions& options,
                             const Progress& progress = {}, UsualValues* usual = nullptr);

/// Moves coincident points back to their previous positions, until all are distinct. Cost: a
/// parallel sort per iteration.
void keep_apart(std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3d>& before);

} // namespace vcarve
