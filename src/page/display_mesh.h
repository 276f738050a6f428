#pragma once

#include "base/progress.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// A surface with at most `max_faces` faces to be looked at, or the surface itself where it has no
/// more. Edges are collapsed by meshoptimizer (quadrics of Garland and Heckbert, SIGGRAPH 1997),
/// one end to the other; whether new faces hide what was seen, as --simplify asks, a picture does
/// not need to know. Rims stay as they are. Of what cannot be collapsed any further, such as very
/// many small pieces, evenly chosen faces are left. Vertices keep their places, colours and points;
/// normals go. The result depends on the arguments alone. Throws Cancelled. Cost: about a second a
/// million faces, on one thread.
TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress = {});

} // namespace vcarve
