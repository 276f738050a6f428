#pragma once

#include "base/progress.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

struct CutCells {
    Labels labels;
    std::int64_t inside = 0;  ///< cells that the cut leaves inside
    std::int64_t on_hull = 0; ///< faces of the hull along which the surface goes on
};

/// Labels each cell outside or inside by what the sights say: a minimum cut (cut.h), which goes on
/// along the hull (hull_faces.h). The labels do not depend on the number of threads.
CutCells cut_cells(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
                   const LabelOptions& options, const Progress& progress);

} // namespace vcarve
