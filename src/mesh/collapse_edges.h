#pragma once

#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace vcarve {

/// Limits of collapse_edges(): it stops at `min_faces` faces, and before the estimated distance of
/// the surface from the given one exceeds `max_distance` (scene units).
struct CollapseLimits {
    std::size_t min_faces = 0;
    double max_distance = std::numeric_limits<double>::infinity();
    bool locks_boundary = false; ///< whether boundary vertices are fixed
};

/// Simplifies a mesh by edge collapses, with meshoptimizer (M. Garland and P. Heckbert, "Surface
/// simplification using quadric error metrics", SIGGRAPH 1997). Remaining vertices keep their
/// positions, colors and points. Normals are dropped. Parts that collapse to two opposite faces are
/// removed. The result may have a few non-manifold edges or vertices.
///
/// `max_distance` is no strict bound: meshoptimizer compares it with a root mean square of
/// distances to planes. On bumpy sheets with noise, the distances of the given vertices to the
/// result have a root mean square of half of it, 97 % are less than it, and all are less than four
/// times as large.
///
/// Without `min_faces`, runs of 100,000 faces are simplified in parallel first, to half of the
/// distance and with fixed boundaries; then the whole mesh, on one thread. The result does not
/// depend on the thread count. Cost: O(faces log faces).
TriMesh collapse_edges(const TriMesh& mesh, const CollapseLimits& limits);

/// Removes pairs of faces with the same three vertices, unless no face would remain. Splitting such
/// pairs would create non-manifold edges inside them. Cost: O(faces log faces).
void remove_folds(std::vector<Face>& faces);

} // namespace vcarve
