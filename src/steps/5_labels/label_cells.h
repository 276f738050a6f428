#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/5_labels/max_flow/max_flow.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// The labeling of least energy: the minimum cut of the visibility terms plus a cost per facet,
/// quality (1 - min(cos phi, cos psi)). phi and psi are the angles between the facet and the
/// circumspheres of its two cells (Labatut, Pons, Keriven 2009, figure 9). Infinite cells and cells
/// that contain views are outside.
Labels cut(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options,
           const Progress& progress = {});

/// The network whose minimum cut cut() returns.
FlowNetwork cut_network(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options);

struct CutCells {
    Labels labels;
    std::int64_t inside = 0;  ///< number of cells that the cut labels inside
    std::int64_t on_hull = 0; ///< number of faces by which the surface continues along the hull
};

/// Labels each cell outside or inside by a minimum cut, and continues the surface along the hull
/// (continue_along_hull()). The labels do not depend on the thread count.
CutCells cut_cells(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
                   const LabelOptions& options, const Progress& progress);

/// Strict carving (Akgunduz, Zetu, Banerjee 2000, section 4.3): a cell is outside if it is infinite
/// or at least `min_crossings` rays cross one of its facets. All other cells are inside. Exact for
/// points without noise; one wrong ray drills a tunnel. Cost: O(cells).
Labels carve(const TetMesh& cells, const Crossings& crossings, int min_crossings);

} // namespace vcarve
