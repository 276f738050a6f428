#pragma once

#include "io/input/read_model.h"
#include "mesh/removed_faces.h"
#include "model/scene_size.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

namespace vcarve {

/// Merges the points of a cloud while they are read, as reconstruct() does with those in memory;
/// nothing where none are to be merged.
Gather thin_while_reading(const ThinOptions& options);

/// The surface of a scene whose points were merged so, if they are of a cloud. `read` is the size
/// of what was read. `removed`, where it is not null, gets the faces that were taken away; they
/// cost time and memory only then, and the surface is the same.
Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, RemovedFaces* removed = nullptr);

} // namespace vcarve
