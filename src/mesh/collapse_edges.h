#pragma once

#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace vcarve {

/// When collapse_edges() stops: at this many faces, or before a vertex moves farther from the
/// surface than this, in scene units.
struct CollapseLimits {
    std::size_t min_faces = 0;
    double max_distance = std::numeric_limits<double>::infinity();
    bool locks_boundary = false; ///< boundary vertices stay
};

/// Simplifies a mesh by edge collapses, by meshoptimizer (M. Garland and P. Heckbert, "Surface
/// simplification using quadric error metrics", SIGGRAPH 1997). Vertices that stay keep their
/// position, color and point; normals are dropped. Parts that collapse to two faces back to back
/// are removed. The result may be non-manifold at few places. Cost: O(faces log faces) on one
/// thread, about 3 s for a million faces.
TriMesh collapse_edges(const TriMesh& mesh, const CollapseLimits& limits);

/// Removes pairs of faces that lie back to back on the same three vertices, unless all do. Edges
/// inside such faces would become non-manifold when they are split. Cost: O(faces log faces).
void remove_folds(std::vector<Face>& faces);

} // namespace vcarve
