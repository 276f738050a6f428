#pragma once

#include "base/options.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/4_labels/max_flow/max_flow.h"

namespace vcarve {

struct CutOptions {
    double quality = 1.0;

    void visit(OptionVisitor& options)
    {
        options.stage("Cut");
        options.number(quality,
                       {.name = "quality",
                        .unit = "sights",
                        .help = "What a badly shaped facet costs in the cut, in sights of full "
                                "weight; 0 lets only the sights decide.",
                        .max = 100'000.0});
    }
};

/// The labelling of least energy: the minimum cut of the visibility terms plus what each
/// facet costs by its shape, quality (1 - min(cos phi, cos psi)) with the angles between the facet
/// and the spheres around its two cells (Labatut, Pons, Keriven 2009, figure 9). Infinite cells and
/// the cells that hold views are outside.
MinimumCut cut(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options);

/// The network that cut() finds the minimum cut of.
FlowNetwork cut_network(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options);

} // namespace vcarve
