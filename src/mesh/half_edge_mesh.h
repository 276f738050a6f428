#pragma once

#include "mesh/edge_table.h"
#include "vcarve/tri_mesh.h"

// The second header needs the first.
// clang-format off
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Double-precision Eigen vectors, vertex normals, and deletion flags.
struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = Eigen::Vector3d;
    using Normal = Eigen::Vector3d;
    VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    VertexTraits
    {
        vcarve::Color color{}; // OpenMesh's traits also define a Color
        std::uint32_t scene_point = kNoPoint;
    };
};

/// The surface during cleanup and refinement: one OpenMesh mesh for all of OpenMesh's modules.
/// Removed elements are only marked as deleted until tri_mesh() omits them, so handles stay valid.
/// OpenMesh can copy but not move a mesh. So this one is changed in place and cannot be copied.
class HalfEdgeMesh : public OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> {
  public:
    using OpenMeshBase = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>; ///< the type for CGAL

    /// Vertices and faces keep their numbers. `twins` has the twin of each half-edge, or
    /// kNoHalfEdge on the boundary. The faces of each vertex must form one fan or one disk, as
    /// split_nonmanifold() ensures. The result equals calls of add_face() for all faces, which take
    /// ten times as long. Normals are zero. Cost: O(faces), mostly in parallel.
    HalfEdgeMesh(const TriMesh& mesh, std::span<const HalfEdge> twins);
    HalfEdgeMesh(const HalfEdgeMesh&) = delete;
    HalfEdgeMesh& operator=(const HalfEdgeMesh&) = delete;

    const Eigen::Vector3d& offset() const { return offset_; } ///< as in TriMesh
    bool has_colors() const { return has_colors_; }
    bool has_scene_points() const { return has_scene_points_; }

    bool is_deleted(OpenMesh::FaceHandle face) const { return status(face).deleted(); }
    /// A vertex without faces counts as deleted.
    bool is_deleted(OpenMesh::VertexHandle vertex) const
    {
        return status(vertex).deleted() || is_isolated(vertex);
    }

    /// The vertices of a face in their original order.
    std::array<OpenMesh::VertexHandle, 3> corners(OpenMesh::FaceHandle face) const;
    std::array<Eigen::Vector3d, 3> triangle(OpenMesh::FaceHandle face) const;

  private:
    Eigen::Vector3d offset_;
    bool has_colors_;
    bool has_scene_points_;
};

/// Converts a handle to an index of parallel arrays, and back.
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

/// The number of vertices with faces, and the number of faces, that are not deleted.
std::int64_t num_vertices_left(const HalfEdgeMesh& mesh);
std::int64_t num_faces_left(const HalfEdgeMesh& mesh);
/// The number of edges with one face. Cost: O(faces), in parallel.
std::int64_t num_boundary_edges(const HalfEdgeMesh& mesh);

/// Returns the remaining faces and their vertices, in the order of `mesh`, with normals. Cost:
/// O(faces), in parallel.
TriMesh tri_mesh(const HalfEdgeMesh& mesh);

/// The unit normal of a vertex: the mean of the normals of its faces, weighted by area. Zero if no
/// face has an area.
Eigen::Vector3d vertex_normal(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle vertex);

/// Sets the normal of every vertex to vertex_normal(). Cost: O(faces), in parallel.
void set_vertex_normals(HalfEdgeMesh& mesh);

/// The median edge length at each vertex, in scene units; 0 for a vertex without faces. Cost:
/// O(faces), in parallel.
std::vector<double> vertex_spacings(const HalfEdgeMesh& mesh);

} // namespace vcarve
