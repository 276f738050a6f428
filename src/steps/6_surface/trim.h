#pragma once

#include "mesh/vertices.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/6_surface/face_rules.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Trims large faces to what views see of them. A kept and seen face with an edge of at least
/// `trim` times the length from which on faces are long (face_rules.h) is halved at its longest
/// edge, and its pieces again, until views see all places on a piece, or none, or its longest edge
/// is no longer than half of that length, or a fourteenth of the face's. Pieces of which no view
/// sees a place go; a graze is enough to keep one. Faces beside are halved along (edge_halving.h),
/// so what is kept has no cracks, and halves that are both kept, or both not, joined again; what is
/// not kept may have cracks. Faces of which images do not tell (is_told_by_images) stay as they
/// are. `surface` is that of `facets`, which ascend, face by face; pieces come after them and have
/// flags of their own in `chosen.keep`. Added vertices are no points of the scene. Returns how many
/// faces lost a piece. Cost: O(faces), and walks from places on each piece to the views, in
/// parallel.
std::int64_t trim_faces(TriMesh& surface, const std::vector<CellFacet>& facets,
                        const FaceVisibility& visibility, const FaceRules& rules,
                        ChosenFaces& chosen);

} // namespace vcarve
