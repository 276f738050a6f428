#pragma once

#include "vcarve/tri_mesh.h"

namespace vcarve {

/// The share of a surface's area in faces with an edge longer than so many times the median edge,
/// which is taken of some thousand faces, evenly spread. 0 for a surface without area. Cost:
/// O(faces), in parallel.
double long_area(const TriMesh& mesh, double times);

} // namespace vcarve
