#pragma once

#include "base/progress.h"
#include "steps/7_refine/sight_guard.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

struct SimplifyCounts {
    std::int64_t faces_before = 0;
    std::int64_t faces = 0;
};

class HalfEdgeMesh;

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

} // namespace vcarve
