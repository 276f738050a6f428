#pragma once

#include "mesh/vertex_faces.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Fills the holes along some kept faces of a surface, as fill_holes() would once it is mended.
/// Faces that are trimmed need that first: with what is trimmed a hole beside them would become one
/// too large to be filled. What fills them is added to the faces, kept. Cost: O(faces) once, and
/// what fill_holes() costs for the faces around.
void fill_holes_beside(const std::vector<std::uint32_t>& some, int max_edges, TriMesh& surface,
                       FaceFlags& keep);

} // namespace vcarve
