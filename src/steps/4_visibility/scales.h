#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

namespace vcarve {

/// What the weights of sights are relative to. Measured once over the whole model, so that every
/// pass that is handed them is local.
struct Scales {
    double short_edge = 0.0;      ///< see short_edge_length(), in the units of the scene
    double median_error_px = 0.0; ///< of the known reprojection errors; 0 where none is known
    double median_views = 1.0;    ///< of the points that any view saw; 1 where none was
};

/// Cost: O(cells + points).
Scales measure_scales(const TetMesh& cells, const Scene& scene);

} // namespace vcarve
