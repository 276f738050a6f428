#pragma once

#include "vcarve/provenance.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// Where the vertices of a surface come from, and how many views its faces rest on. Needs
/// TriMesh::points. Of points at one place, which became one, the id and error are those of the
/// best and the views those of all. Throws InputError where a point id is beyond 2^53, which no
/// property of a PLY file holds exactly. Cost: O(faces x views of their points), in parallel.
Provenance find_provenance(const TriMesh& mesh, const Scene& scene);

} // namespace vcarve
