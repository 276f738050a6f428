#pragma once

#include "model/tri_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace vcarve {

/// What an OpenMesh surface of ours carries: double positions, and per vertex what a TriMesh has.
struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::None);
    FaceAttributes(OpenMesh::Attributes::None);
    VertexTraits
    {
        vcarve::Color color{}; // the traits have a Color of their own
        std::uint32_t point = kNoPoint;
    };
};

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

/// The number of a vertex, edge or face, for arrays that run parallel to them.
template <typename Handle>
std::size_t index(Handle handle)
{
    return static_cast<std::size_t>(handle.idx());
}

/// Vertices and faces keep their numbers. Only for a manifold, consistently oriented surface;
/// anything else is a mistake of the caller: std::logic_error. Normals are not taken over.
HalfEdgeMesh half_edge_mesh(const TriMesh& mesh);

/// The faces to keep (one flag a face) and their vertices, in the order they have in `mesh`, with
/// normals (see vertex_normal), and with colours and points if `like` has them; its offset is taken
/// over.
TriMesh kept_surface(const HalfEdgeMesh& mesh, const std::vector<char>& keep_faces,
                     const TriMesh& like);

/// The unit normal of a vertex: the mean over its faces, weighted by area. Zero where no face
/// around it has an area.
OpenMesh::Vec3d vertex_normal(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle vertex);

} // namespace vcarve
