#pragma once

#include "base/options.h"
#include "model/tri_mesh.h"
#include "steps/6_refine/sight_guard.h"

namespace vcarve {

struct SimplifyOptions {
    int faces = 0;

    void visit(OptionVisitor& options)
    {
        options.count(faces, {.name = "simplify",
                              .unit = "faces",
                              .help = "Merge vertices until so many faces are left, never so that "
                                      "a face hides a point from a view that it did not hide; 0 "
                                      "keeps all."});
    }
};

/// The surface with at most `options.faces` faces, or with more where no vertex can be merged any
/// further: by collapsing the edge that costs least, again and again (Garland and Heckbert,
/// "Surface simplification using quadric error metrics", SIGGRAPH 1997; quadrics weighted by area,
/// rims held by planes across them). One end of an edge goes to the other, so vertices that stay
/// have their places, colours and points. Normals are made anew.
///
/// A collapse is ruled out if a new face would block a free sight of `guard`, turn by more than 60
/// degrees, be more of a sliver than those it replaces, or if it would leave a surface that is not
/// manifold; a closed surface stays closed, and no piece vanishes. Takes a manifold, consistently
/// oriented surface. Cost: O(vertices log vertices + collapses x sights near them), on one thread.
TriMesh simplify_surface(const TriMesh& mesh, const SightGuard& guard,
                         const SimplifyOptions& options);

} // namespace vcarve
