#pragma once

#include "model/visibility_energy.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/trace.h"

namespace vcarve {

/// The crossings of the rays of a scene.
inline Crossings crossings_of(const TetMesh& cells, const Scene& scene)
{
    Log silent;
    Stage stage(silent, "rays");
    Crossings crossings;
    CrossingCounter(cells).cast(photographs(scene), crossings, stage);
    return crossings;
}

/// The visibility energy of the rays of a scene.
inline VisibilityEnergy energy_of(const TetMesh& cells, const Scene& scene,
                                  const TraceOptions& options = {})
{
    Log silent;
    Stage stage(silent, "rays");
    VisibilityEnergy energy;
    RayCaster(cells, scene, measure_scales(cells, scene), options)
        .cast(photographs(scene), energy, stage);
    return energy;
}

} // namespace vcarve
