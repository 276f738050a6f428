#pragma once

#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// Divides faces until no edge is longer than 1.4 times the `spacing` at its ends (scene units, one
/// per vertex; infinite: divide nothing here). All long edges of a face are divided at once at
/// their midpoints, in rounds, so faces keep their shape and the surface stays conforming. Colors
/// are dropped. A midpoint gets the scene point of one end, and `spacing` grows with the vertices.
/// Stops before `most` vertices are exceeded. Cost: O(faces log faces) per round.
void divide_faces(TriMesh& mesh, std::vector<float>& spacing, std::size_t most);

} // namespace vcarve
