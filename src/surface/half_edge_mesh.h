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

/// Vertices and faces keep their numbers. Only for a manifold, consistently oriented surface;
/// anything else is a mistake of the caller: std::logic_error. Normals are not taken over.
HalfEdgeMesh half_edge_mesh(const TriMesh& mesh);

/// The unit normal of a vertex: the mean over its faces, weighted by area. Zero where no face
/// around it has an area.
OpenMesh::Vec3d vertex_normal(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle vertex);

} // namespace vcarve
