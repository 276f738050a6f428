#pragma once

#include "mesh/half_edge_mesh.h"
#include "steps/5_surface/split_nonmanifold.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// The faces of a manifold surface that touch its borders, as a half-edge mesh to fill holes in:
/// most of a surface is nowhere near a hole, and building half-edges takes longer than all else.
/// Every vertex on a border of the surface has all its faces; the other borders of the collar are
/// where the surface goes on. Borders come in the order they have in the surface.
class Collar {
  public:
    /// Only the faces with a flag. Cost: O(faces), most for those that touch borders.
    Collar(const TriMesh& mesh, const std::vector<Side>& mates,
           const std::vector<char>& keep_faces);

    /// Fills the holes of at most so many edges. Returns how many there were.
    std::int64_t fill_holes(int max_edges);

    /// Adds what fill_holes added to the surface that the collar was made from, and the normals of
    /// all vertices on its borders and of new ones. The surface must have normals.
    void add_to(TriMesh& mesh) const;

  private:
    bool on_border(OpenMesh::VertexHandle vertex) const
    {
        return index(vertex) >= on_border_.size() || on_border_[index(vertex)] != 0;
    }
    /// In the surface; new vertices follow its own.
    std::uint32_t number(OpenMesh::VertexHandle vertex) const;

    std::size_t num_vertices_;            ///< of the surface
    std::vector<std::uint32_t> vertices_; ///< those of the collar in the surface
    std::vector<char> on_border_;         ///< per vertex of the collar
    std::size_t num_faces_ = 0;           ///< of the collar, before holes are filled
    HalfEdgeMesh half_edges_;
};

} // namespace vcarve
