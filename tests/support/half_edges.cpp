#include "support/half_edges.h"

#include "steps/6_surface/split_nonmanifold.h"

#include <stdexcept>

namespace vcarve::testing {

HalfEdgeMesh half_edges(const TriMesh& mesh)
{
    const ManifoldSurface manifold = split_nonmanifold(mesh);
    return HalfEdgeMesh(manifold.mesh, manifold.twins);
}

HalfEdgeMesh::OpenMeshBase half_edges_face_by_face(const TriMesh& mesh)
{
    HalfEdgeMesh::OpenMeshBase made;
    for (const Eigen::Vector3d& position : mesh.positions) {
        made.add_vertex(position);
    }
    for (const Face& face : mesh.faces) {
        const auto vertex = [&](std::size_t i) {
            return handle_at<OpenMesh::VertexHandle>(face[i]);
        };
        if (!made.add_face(vertex(0), vertex(1), vertex(2)).is_valid()) {
            throw std::logic_error("the surface is not manifold");
        }
    }
    return made;
}

} // namespace vcarve::testing
