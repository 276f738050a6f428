#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "io/images/find_photographs.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// The views of a scene, in the frame of a mesh, with their masks as `file`. Views without a mask
/// have no file. Skips views with an unknown lens.
std::vector<CalibratedPhoto> views_with_masks(const Scene& scene, const Photographs& masks,
                                              const Eigen::Vector3d& mesh_offset);

/// Removes the faces that more views see only in masked pixels than in another pixel, and what
/// this leaves of connected components if no view sees it in another pixel. A view without `file`,
/// or with an unreadable one, has no masked pixels. Components that no view sees stay, but those
/// with fewer than `min_component` faces are removed, see CleanupOptions. The result
/// is manifold and oriented if the mesh is. Throws Cancelled. Cost: up to seven rays per face and
/// view; views without a mask are only asked about a face until the others are outvoted. One mask
/// per thread in memory.
TriMesh without_masked_faces(const TriMesh& mesh, const std::vector<CalibratedPhoto>& views,
                             int min_component, const Progress& progress);

} // namespace vcarve
