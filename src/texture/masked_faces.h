#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// Removes the faces that most views see only in masked pixels, and the connected components
/// without a face that a view sees in another pixel. `masks` are the masks with their views'
/// cameras; unreadable masks are ignored. The result is manifold and oriented if the mesh
/// is. Throws Cancelled. Cost: up to seven rays per face and view; one mask per thread in memory.
TriMesh without_masked_faces(const TriMesh& mesh, const std::vector<CalibratedPhoto>& masks,
                             const Progress& progress);

} // namespace vcarve
