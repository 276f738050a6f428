#pragma once

#include "base/log.h"
#include "steps/7_refine/simplify.h"
#include "steps/7_refine/smooth.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// Moves vertices (smooth.h), then merges them (simplify.h), each where it is asked for. Neither
/// makes a face hide a point from a view that it did not hide before (sight_guard.h). The vertices
/// must know their points of the scene.
void refine(HalfEdgeMesh& mesh, const Scene& scene, const RefineOptions& options, Log& log);

} // namespace vcarve
