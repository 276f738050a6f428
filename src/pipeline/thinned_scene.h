#pragma once

#include "io/input/read_model.h"
#include "model/scene_check.h"
#include "steps/6_surface/carve_surface.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

namespace vcarve {

/// Returns a function that merges the points of a cloud while they are read, as reconstruct() does
/// in memory. Empty if merging is disabled.
Gather thin_while_reading(const ThinOptions& options);

/// Reconstructs a scene. The points of a cloud must have been merged by thin_while_reading().
/// `read` is the size of the input. `removed` receives the removed faces; null saves time and
/// memory.
Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, RemovedFaces* removed = nullptr);

} // namespace vcarve
