#pragma once

#include "mesh/half_edge_mesh.h"

namespace vcarve::testing {

/// A surface as half-edges. Non-manifold edges and vertices are split first.
HalfEdgeMesh half_edges(const TriMesh& mesh);

/// The same, built by OpenMesh face by face, which searches for every edge. The fast construction
/// must agree with it. The mesh must be manifold.
HalfEdgeMesh::OpenMeshBase half_edges_face_by_face(const TriMesh& mesh);

} // namespace vcarve::testing
