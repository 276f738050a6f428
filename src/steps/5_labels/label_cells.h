#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/5_labels/max_flow/max_flow.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// The labelling of least energy: the minimum cut of the visibility terms plus what each
/// facet costs by its shape, quality (1 - min(cos phi, cos psi)) with the angles between the facet
/// and the spheres around its two cells (Labatut, Pons, Keriven 2009, figure 9). Infinite cells and
/// the cells that hold views are outside.
Labels cut(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options,
           const Progress& progress = {});

/// The network that cut() finds the minimum cut of.
FlowNetwork cut_network(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options);

struct CutCells {
    Labels labels;
    std::int64_t inside = 0;  ///< cells that the cut leaves inside
    std::int64_t on_hull = 0; ///< faces of the hull along which the surface goes on
};

/// Labels each cell outside or inside by what the sights say: a minimum cut, which goes on
/// along the hull (go_on_along_hull). The labels do not depend on the number of threads.
CutCells cut_cells(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
                   const LabelOptions& options, const Progress& progress);

/// Strict carving (Akgunduz, Zetu, Banerjee 2000, section 4.3): a cell is outside if it is infinite
/// or one of its facets is crossed by at least `min_crossings` sights; all others are inside. Exact
/// on points without noise; one wrong sight drills a tunnel. Cost: O(cells).
Labels carve(const TetMesh& cells, const Crossings& crossings, int min_crossings);

} // namespace vcarve
