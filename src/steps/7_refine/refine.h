#pragma once

#include "base/progress.h"
#include "steps/7_refine/sight_guard.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

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
/// point is in which direction, its sights tell (covariance_of_a_pixel). How many pixels its places
/// in images are off, reprojection errors tell: the median over the points of their mean error,
/// over what the mean length of an error is for a deviation of one pixel, and for what fitting the
/// point took away, sqrt(pi / 2) sqrt((2 n - 3) / (2 n)) with n views; but no more than heights
/// above the surface tell, where errors are large since cameras are known badly; heights tell alone
/// where no error is known, unless one vertex in twenty lies in one plane with all around it. So
/// which cells are inside was told by points as they are, and only then noise is taken off.
///
/// A vertex moves by at most `options.denoise` standard deviations and a quarter of its spacing,
/// and half or a quarter of that, or stays, where a face around it would turn by more than 60
/// degrees otherwise. Rims stay, and so do points that were added and those whose reprojection
/// error is not known where others are. Normals are made anew. The result is the same for any
/// number of threads. Cost: O(vertices), in parallel; 250 bytes a vertex.
SettleCounts settle_vertices(HalfEdgeMesh& mesh, const Scene& scene, const DenoiseOptions& options,
                             const Progress& progress = {});

struct SimplifyCounts {
    std::int64_t faces_before = 0;
    std::int64_t faces = 0;
};

/// Leaves at most `options.faces` faces, or more where no vertex can be merged any further: by
/// collapsing edges, the cheapest first (Garland and Heckbert, "Surface simplification using
/// quadric error metrics", SIGGRAPH 1997; quadrics weighted by area, rims held by planes across
/// them), of those that are cheapest many at a time. One end of an edge goes to the other, so
/// vertices that stay have their places, colours and points. Normals are made anew.
///
/// A collapse is ruled out if a new face would block a free sight of `guard`, turn by more than 60
/// degrees, be more of a sliver than those it replaces, or if it would leave a surface that is not
/// manifold; a closed surface stays closed, and no piece vanishes.
/// Cost: O(vertices log vertices + collapses x sights near them), the latter in parallel.
SimplifyCounts simplify_surface(HalfEdgeMesh& mesh, const SightGuard& guard,
                                const SimplifyOptions& options, const Progress& progress = {});

struct SmoothCounts {
    std::int64_t vertices = 0; ///< of the surface
    std::int64_t moved = 0;    ///< vertices that are elsewhere than before
    std::int64_t held = 0;     ///< vertices that a sight kept from going all the way
};

/// Moves vertices so that faces take the directions of those around them that differ little, which
/// flattens noise and keeps edges: `options.iterations` times the normals are filtered (Zheng, Fu,
/// Au, Tai, "Bilateral normal filtering for mesh denoising", TVCG 2011, local scheme; spread 0.2 of
/// unit normals) and vertices follow them (Sun, Rosin, Martin, Langbein, "Fast and effective
/// feature-preserving mesh denoising", TVCG 2007), three rounds each.
///
/// A vertex stays within half its spacing of where it was, and goes a half or a quarter of its way,
/// or stays, where a face around it would turn by more than 60 degrees or block a free sight of
/// `guard`. Rims stay, faces and colours too; normals are made anew. Cost: O(iterations x faces x
/// sights near them), in parallel; the result does not depend on the number of threads.
SmoothCounts smooth_surface(HalfEdgeMesh& mesh, const SightGuard& guard,
                            const SmoothOptions& options, const Progress& progress = {});

} // namespace vcarve
