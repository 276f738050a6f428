#pragma once

#include "mesh/vertices.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/6_surface/face_rules.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Trims large faces to their visible parts. A seen, kept face with an edge of at least L = `trim`
/// x closing_length() is bisected at its longest edge, and so are its pieces. This ends if views
/// see all samples of a piece or none, or if its longest edge is at most L / 2 or a fourteenth of
/// the face's. Pieces are dropped if no view sees a sample, even at a grazing angle. Neighbors are
/// bisected, too (edge_halving.h), so the kept surface has no cracks; the dropped part may have
/// some. Two halves are merged again if both are kept or both dropped. Faces with unreliable images
/// (has_reliable_visibility) stay.
///
/// `surface` is that of the boundary. New pieces are appended to the faces and to
/// `chosen.keep`. New vertices are no points of the scene. Returns the number of faces that lost a
/// piece. Cost: O(faces), and walks from samples of each piece to the views, in parallel.
std::int64_t trim_faces(TriMesh& surface, const Boundary& boundary, const FaceRules& rules,
                        ChosenFaces& chosen);

} // namespace vcarve
