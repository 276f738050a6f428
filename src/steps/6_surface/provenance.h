#pragma once

#include "vcarve/provenance.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// Returns the points of the vertices, and the number of views that support each face. Needs
/// TriMesh::points. For merged points at one position, the id and error are those of the best
/// point, and the views those of all. Throws InputError if a point id is above 2^53, because PLY
/// properties cannot store it exactly. Cost: O(faces x views of their points), in parallel.
Provenance find_provenance(const TriMesh& mesh, const Scene& scene);

class HalfEdgeMesh;

/// Agreement of normals with the views of a face (Akgunduz, Zetu, Banerjee 2000, section 4.5).
struct ViewAgreement {
    std::int64_t rays = 0;   ///< number of pairs of a face corner and a view of its point
    std::int64_t facing = 0; ///< pairs with the normal within 90 degrees of the ray
};

/// Checks the orientation, which the labels make correct by construction, and changes nothing.
/// Corners without a point do not count. Cost: O(faces x track length), in parallel.
ViewAgreement view_agreement(const HalfEdgeMesh& mesh, const Scene& scene);

} // namespace vcarve
