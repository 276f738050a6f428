#pragma once

#include "model/tet_mesh.h"

namespace vcarve {

/// The 25th percentile of the lengths of finite edges: how far apart neighbouring points are, in
/// the units of the scene. Of meshes beyond 50,000 cells a fixed choice of about as many edges
/// stands for all. Cost: O(cells), in parallel.
double short_edge_length(const TetMesh& mesh);

} // namespace vcarve
