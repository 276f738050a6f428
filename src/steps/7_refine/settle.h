#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

class HalfEdgeMesh;

struct SettleCounts {
    std::int64_t vertices = 0; ///< of the surface
    std::int64_t moved = 0;    ///< vertices that are elsewhere than before
    std::int64_t held = 0;     ///< vertices that a face kept from going all the way
    double noise_px = 0.0;     ///< standard deviation of a point's places in the images
};

/// Settles vertices on the surface that those around agree on, within the uncertainty of their
/// points: the bilateral filter of bilateral_filter.h, over the vertices beside each and across the
/// edges opposite to it, the 16 nearest of them, with the normals of the surface. How uncertain a
/// point is in which direction, its sights tell (pixel_covariance.h). How many pixels its places in
/// images are off, reprojection errors tell: the median over the points of their mean error, over
/// what the mean length of an error is for a deviation of one pixel, and for what fitting the point
/// took away, sqrt(pi / 2) sqrt((2 n - 3) / (2 n)) with n views; but no more than heights above the
/// surface tell, where errors are large since cameras are known badly; heights tell alone where no
/// error is known, unless one vertex in twenty lies in one plane with all around it. So which cells
/// are inside was told by points as they are, and only then noise is taken off.
///
/// A vertex moves by at most `options.denoise` standard deviations and a quarter of its spacing,
/// and half or a quarter of that, or stays, where a face around it would turn by more than 60
/// degrees otherwise. Rims stay, and so do points that were added and those whose reprojection
/// error is not known where others are. Normals are made anew. The result is the same for any
/// number of threads. Cost: O(vertices), in parallel; 250 bytes a vertex.
SettleCounts settle_vertices(HalfEdgeMesh& mesh, const Scene& scene, const DenoiseOptions& options,
                             const Progress& progress = {});

} // namespace vcarve
