#pragma once

#include "io/input/read_model.h"
#include "model/scene_check.h"
#include "run/work_folder.h"
#include "steps/6_surface/carve_surface.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

namespace vcarve {

/// Returns a function that merges the points of a cloud while they are read, as reconstruct() does
/// in memory. Empty if merging is disabled.
Gather thin_while_reading(const ThinOptions& options);

/// Optional inputs and outputs of a run. They do not change the surface.
struct RunExtras {
    /// Receives the removed faces; null saves time and memory.
    RemovedFaces* removed = nullptr;
    /// The folder of checkpoints, or null for none. Its begin() was called with the job of the
    /// scene and the options.
    WorkFolder* work = nullptr;
};

/// Reconstructs a scene. The points of a cloud must have been merged by thin_while_reading().
/// `read` is the size of the input.
Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, const RunExtras& extras = {});

} // namespace vcarve
