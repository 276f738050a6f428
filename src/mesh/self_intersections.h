#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// How many pairs of faces have more in common than corners and edges of both. Exact. Corners at
/// one position are one, so copies of a vertex, made where a surface was not manifold, may touch.
/// Faces whose corners are on a line are left out. Cost: O(faces log faces) and what their boxes
/// meet, on many threads.
std::int64_t count_self_intersections(const TriMesh& mesh);

} // namespace vcarve
