#pragma once

#include "vcarve/provenance.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// Where the vertices of a surface come from, and how many views its faces rest on. Needs
/// TriMesh::points. Of points at one place, which became one, the id and error are those of the
/// best and the views those of all. Throws InputError where a point id is beyond 2^53, which no
/// property of a PLY file holds exactly. Cost: O(faces x views of their points), in parallel.
Provenance find_provenance(const TriMesh& mesh, const Scene& scene);

class HalfEdgeMesh;

/// How well a surface faces the views that saw it (Akgunduz, Zetu, Banerjee 2000, section 4.5).
struct ViewAgreement {
    std::int64_t sights = 0; ///< pairs of a face corner and a view that saw its point
    std::int64_t facing = 0; ///< those where the face's normal is within 90 degrees of the view
};

/// Counts, without changing anything: orientation comes from the labels and is right by
/// construction; this checks it. Corners without a point do not count. Cost: O(faces x track
/// length), in parallel.
ViewAgreement view_agreement(const HalfEdgeMesh& mesh, const Scene& scene);

} // namespace vcarve
