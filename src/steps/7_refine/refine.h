#pragma once

#include "base/progress.h"
#include "model/usual_values.h"
#include "steps/7_refine/ray_guard.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

class HalfEdgeMesh;

struct DenoiseVerticesCounts {
    std::int64_t vertices = 0; ///< number of vertices of the mesh
    std::int64_t moved = 0;    ///< vertices that moved
    std::int64_t held = 0;     ///< vertices that a face prevented from moving all the way
    double noise_px = 0.0;     ///< standard deviation of the points' image positions, in pixels
};

/// Moves vertices, within their uncertainty, to the surface that their neighbors agree on, by the
/// bilateral filter of bilateral_filter.h with the surface's normals. Neighbors are the adjacent
/// vertices and those across the opposite edges, at most the 16 nearest. The uncertainty of a point
/// in each direction follows from its rays (covariance_of_a_pixel). Labels use the original points.
///
/// The noise in pixels is the median over the points of e / sqrt(pi / 2) / sqrt((2n-3)/(2n)), with
/// mean reprojection error e and n views. The first factor is the mean error for a deviation of one
/// pixel, the second the loss by fitting the point. If heights above the surface show less noise,
/// that counts, since bad cameras cause large errors. If no error is known, only heights count, and
/// nothing moves if more than one vertex in twenty is coplanar with its neighbors.
///
/// A vertex moves by at most `options.denoise` standard deviations and a quarter of its spacing. It
/// moves a half or a quarter of the way, or stays, if a face around it would turn by more than 60
/// degrees. Boundary vertices and added points stay. Points with unknown errors stay if others are
/// known. Recomputes normals. The result is the same for any thread count. Cost: O(vertices), in
/// parallel; 250 bytes per vertex.
DenoiseVerticesCounts denoise_vertices(HalfEdgeMesh& mesh, const Scene& scene,
                                       const DenoiseOptions& options, const Progress& progress = {},
                                       UsualValues* usual = nullptr);

struct SimplifyCounts {
    std::int64_t faces_before = 0;
    std::int64_t faces = 0;
};

/// Simplifies the mesh to at most `options.faces` faces, or more if no further vertex can be
/// merged. Collapses edges, the cheapest first (Garland and Heckbert, "Surface simplification using
/// quadric error metrics", SIGGRAPH 1997). Quadrics are weighted by area, and planes across
/// boundaries preserve these. Each pass collapses many of the cheapest edges. One vertex of an edge
/// moves to the other, so remaining vertices keep position, color and point. Recomputes normals.
///
/// Rejects a collapse if a new face would block a free ray of `guard`, turn by more than 60
/// degrees, or be more of a sliver than the replaced faces. The surface stays manifold, closed
/// surfaces stay closed, and no connected component vanishes. Cost: O(vertices log vertices +
/// collapses x rays near them), the latter in parallel.
SimplifyCounts simplify_surface(HalfEdgeMesh& mesh, const RayGuard& guard,
                                const SimplifyOptions& options, const Progress& progress = {});

struct SmoothCounts {
    std::int64_t vertices = 0; ///< number of vertices of the mesh
    std::int64_t moved = 0;    ///< vertices that moved
    std::int64_t held = 0;     ///< vertices that a ray prevented from moving all the way
};

/// Smooths the mesh: aligns faces with neighbors of similar normals, which flattens noise and
/// preserves edges. Each iteration first filters the normals (Zheng, Fu, Au, Tai, "Bilateral normal
/// filtering for mesh denoising", TVCG 2011, local scheme; spread 0.2 of unit normals). Then it
/// updates the vertices (Sun, Rosin, Martin, Langbein, "Fast and effective feature-preserving mesh
/// denoising", TVCG 2007). Both take three rounds.
///
/// A vertex stays within half its spacing of its original position. It moves a half or a quarter of
/// the way, or stays, if a face around it would turn by more than 60 degrees or block a free ray of
/// `guard`. Boundary vertices, faces and colors are unchanged; normals are recomputed. The result
/// is the same for any thread count. Cost: O(iterations x faces x rays near them), in parallel.
SmoothCounts smooth_surface(HalfEdgeMesh& mesh, const RayGuard& guard, const SmoothOptions& options,
                            const Progress& progress = {});

} // namespace vcarve
