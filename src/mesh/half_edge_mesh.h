#pragma once

#include "mesh/edge_table.h"
#include "vcarve/tri_mesh.h"

// The second needs the first.
// clang-format off
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Eigen's vectors in double precision; normals of vertices; marks on what is deleted.
struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;
    using Normal = Eigen::Vector3d;
    VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    VertexTraits
    {
        vcarve::Color color{}; // the traits have a Color of their own
        std::uint32_t scene_point = kNoPoint;
    };
};

/// The surface while it is mended and refined: one OpenMesh mesh that all of its modules work on.
/// What is removed stays as deleted until tri_mesh() leaves it out, so handles stay valid. OpenMesh
/// can only copy a mesh, never move it, hence it is changed in place and cannot be copied.
class HalfEdgeMesh : public OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> {
  public:
    using OpenMeshBase = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>; ///< as CGAL knows it

    /// Vertices and faces keep their numbers. `twins` has for each half-edge of a face the one it
    /// shares an edge with, or kNoHalfEdge at a border; every vertex must have one fan or one disk
    /// of faces, as split_nonmanifold() makes it. The mesh is the same as if add_face() had been
    /// called for each face, which takes ten times as long. Normals are zero. Cost: O(faces),
    /// mostly in parallel.
    HalfEdgeMesh(const TriMesh& mesh, std::span<const HalfEdge> twins);
    HalfEdgeMesh(const HalfEdgeMesh&) = delete;
    HalfEdgeMesh& operator=(const HalfEdgeMesh&) = delete;

    const Eigen::Vector3d& offset() const { return offset_; } ///< as that of a TriMesh
    bool has_colors() const { return has_colors_; }
    bool has_scene_points() const { return has_scene_points_; }

    bool is_deleted(OpenMesh::FaceHandle face) const { return status(face).deleted(); }
    /// A vertex of no face is as good as deleted.
    bool is_deleted(OpenMesh::VertexHandle vertex) const
    {
        return status(vertex).deleted() || is_isolated(vertex);
    }

    /// The vertices of a face, from the one it began with on.
    std::array<OpenMesh::VertexHandle, 3> corners(OpenMesh::FaceHandle face) const;
    std::array<Eigen::Vector3d, 3> triangle(OpenMesh::FaceHandle face) const;

  private:
    Eigen::Vector3d offset_;
    bool has_colors_;
    bool has_scene_points_;
};

/// The number of a vertex, edge or face, for arrays that run parallel to them, and back.
template <typename Handle>
std::size_t index(Handle handle)
{
    return static_cast<std::size_t>(handle.idx());
}
template <typename Handle>
Handle handle_at(std::size_t number)
{
    return Handle(static_cast<int>(number));
}

/// How many vertices of faces, and faces, are not deleted.
std::int64_t num_vertices_left(const HalfEdgeMesh& mesh);
std::int64_t num_faces_left(const HalfEdgeMesh& mesh);
/// Edges of one face that is left. Cost: O(faces), in parallel.
std::int64_t num_boundary_edges(const HalfEdgeMesh& mesh);

/// The faces that are not deleted, and their vertices, in the order they have in `mesh`, with
/// normals. Cost: O(faces), in parallel.
TriMesh tri_mesh(const HalfEdgeMesh& mesh);

/// The unit normal of a vertex: the mean over its faces, weighted by area. Zero where no face
/// around it has an area.
Eigen::Vector3d vertex_normal(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle vertex);

/// Gives every vertex its vertex_normal(). Cost: O(faces), in parallel.
void set_vertex_normals(HalfEdgeMesh& mesh);

/// Per vertex the median length of the edges there, in scene units; 0 for a vertex of no face.
/// Cost: O(faces), in parallel.
std::vector<double> vertex_spacings(const HalfEdgeMesh& mesh);

} // namespace vcarve
