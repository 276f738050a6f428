#pragma once

#include "mesh/vertex_faces.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// What to trim. Holds references.
struct TrimRules {
    const FaceFlags& unseen; ///< faces that no view sees; if kept, they round a rim off
    const SurfaceOptions& options;
};

struct TrimmedFaces {
    std::int64_t count = 0; ///< faces that lost a piece
    /// What fills holes beside large faces (holes_beside.h), before it was halved along.
    std::vector<std::array<Eigen::Vector3d, 3>> filled;
};

/// Trims large faces to what views see of them. A kept face with an edge of at least half of
/// `max_sheet` times the diameter of what was looked at (region_of_interest) is halved at its
/// longest edge, and its pieces again, until views see all places on a piece, or none, or its
/// longest edge is no longer than a quarter of that, or a sixteenth of the face's. Pieces of which
/// no view sees a place go; a graze is enough to keep one. Pieces as large as the faces that are
/// trimmed are looked at in nine places more. Faces beside are halved along (edge_halving.h), so
/// what is kept has no cracks, and halves that are both kept, or both not, joined again. Vertices
/// in straight rims are taken out where they can be (straight_rims.h); what is not kept may have
/// cracks there. Before all that, holes along such faces are filled (holes_beside.h). `boundary` is
/// the surface of `facets`, which ascend, face by face; what is added comes after them and has
/// flags of its own. Added vertices are no points of the scene. Faces that are `unseen` and those
/// of which images do not tell (is_told_by_images) stay as they are; all others are trimmed,
/// whether kept for what views see or for their points. Where `max_sheet` is 0, nothing is trimmed.
/// Cost: O(faces), and walks from places on each piece to the views, in parallel.
TrimmedFaces trim_faces(TriMesh& boundary, const std::vector<CellFacet>& facets,
                        const FaceVisibility& visibility, const TrimRules& rules, FaceFlags& keep);

} // namespace vcarve
