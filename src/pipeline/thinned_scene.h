#pragma once

#include "io/input/read_model.h"
#include "model/scene_check.h"
#include "run/ranks.h"
#include "run/work_folder.h"
#include "steps/6_surface/carve_surface.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

namespace vcarve {

/// Merges the points of a cloud while they are read, as reconstruct() does with those in memory;
/// nothing where none are to be merged.
Gather thin_while_reading(const ThinOptions& options);

/// What a run has beside a scene and options; nothing of it changes the surface.
struct RunExtras {
    /// Gets the faces that were taken away, which cost time and memory only where it is not null.
    RemovedFaces* removed = nullptr;
    /// Where stages are kept, and taken from where an earlier run kept them; null for nowhere. It
    /// has begun the job that the scene and the options are of.
    WorkFolder* work = nullptr;
    /// The other processes that work on it; null where there are none.
    Ranks* ranks = nullptr;
};

/// The surface of a scene whose points were merged so, if they are of a cloud. `read` is the size
/// of what was read.
Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, const RunExtras& extras = {});

} // namespace vcarve
