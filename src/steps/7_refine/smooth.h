#pragma once

#include "base/progress.h"
#include "steps/7_refine/sight_guard.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

struct SmoothCounts {
    std::int64_t vertices = 0; ///< of the surface
    std::int64_t moved = 0;    ///< vertices that are elsewhere than before
    std::int64_t held = 0;     ///< vertices that a sight kept from going all the way
};

class HalfEdgeMesh;

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
