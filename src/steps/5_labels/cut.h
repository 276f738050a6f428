#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/5_labels/max_flow/max_flow.h"
#include "vcarve/options.h"

namespace vcarve {

/// The labelling of least energy: the minimum cut of the visibility terms plus what each
/// facet costs by its shape, quality (1 - min(cos phi, cos psi)) with the angles between the facet
/// and the spheres around its two cells (Labatut, Pons, Keriven 2009, figure 9). Infinite cells and
/// the cells that hold views are outside.
Labels cut(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options,
           const Progress& progress = {});

/// The network that cut() finds the minimum cut of.
FlowNetwork cut_network(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options);

} // namespace vcarve
