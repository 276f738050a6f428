#pragma once

#include "io/input/read_model.h"
#include "model/scene_size.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

namespace vcarve {

/// Merges the points of a cloud while they are read, as reconstruct() does with those in memory;
/// nothing where none are to be merged.
Gather thin_while_reading(const ThinOptions& options);

/// The surface of a scene whose points were merged so, if they are of a cloud. `read` is the size
/// of what was read.
Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log);

} // namespace vcarve
