#pragma once

#include "mesh/half_edge_mesh.h"

namespace vcarve::testing {

/// A surface as half-edges, taken apart before where it is not manifold.
HalfEdgeMesh half_edges(const TriMesh& mesh);

/// The same made face by face by OpenMesh, which looks for every edge: what a fast way must agree
/// with. The mesh must be manifold.
HalfEdgeMesh::OpenMeshBase half_edges_face_by_face(const TriMesh& mesh);

} // namespace vcarve::testing
