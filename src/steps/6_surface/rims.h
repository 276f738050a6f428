#pragma once

#include "mesh/vertex_faces.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// Puts back small faces that turn away from all views, where a view sees the edge they share with
/// a kept face: a surface that bends out of sight then ends behind its bend, not in view. Small is
/// a face whose longest edge is at most three local edges and four times what the median kept face
/// has. Only faces with a flag in `may_return` are put back. `boundary` is the surface of `facets`,
/// which ascend, face by face. Cost: O(faces), and some walks a view for each edge at the rim;
/// mostly in parallel.
void round_off_rims(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                    const FaceVisibility& visibility, const FaceFlags& may_return, FaceFlags& keep);

} // namespace vcarve
