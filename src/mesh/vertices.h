#pragma once

#include "base/arrays.h"
#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Which of the corners of a face a vertex is; 3 where it is none.
inline std::size_t corner_of(const Face& face, std::uint32_t vertex)
{
    return static_cast<std::size_t>(std::ranges::find(face, vertex) - face.begin());
}

/// A face with another vertex instead of one of its own.
inline Face with(Face face, std::uint32_t corner, std::uint32_t other)
{
    std::ranges::replace(face, corner, other);
    return face;
}

/// A face from one of its corners on.
inline Face turned_to(const Face& face, std::uint32_t corner)
{
    if (face[0] == corner) return face;
    if (face[1] == corner) return {face[1], face[2], face[0]};
    return {face[2], face[0], face[1]};
}

using FaceFlags = std::vector<std::uint8_t>; ///< one a face, 0 or 1

/// The faces at each vertex: one row of face numbers a vertex, ascending.
class VertexFaces {
  public:
    /// Of the faces with a flag only; of all where there are no flags. Cost: O(faces) time, in
    /// parallel, 12 bytes a face and 4 a vertex.
    VertexFaces(std::span<const Face> faces, std::size_t num_vertices, const FaceFlags& flags = {});

    std::span<const std::uint32_t> operator[](std::size_t vertex) const { return table_[vertex]; }

  private:
    RowTable table_;
};

inline constexpr std::array<int, 3> kCorners = {0, 1, 2}; ///< of a face

/// Shows visit(other) the other faces that have the edge of a face from a corner to the next, in
/// either direction, of those that are given at the vertices. Cost: O(faces at the corner).
template <typename Visit>
void visit_beside(std::span<const Face> faces, std::uint32_t face, int corner,
                  const VertexFaces& faces_at, const Visit& visit)
{
    const std::uint32_t to = faces[face][(corner + 1) % 3];
    for (const std::uint32_t other : faces_at[faces[face][corner]]) {
        if (other != face && std::ranges::count(faces[other], to) > 0) visit(other);
    }
}

/// The vertices that faces use, ascending. Cost: O(faces + vertices), in parallel.
std::vector<std::uint32_t> used_vertices(const std::vector<Face>& faces, std::size_t num_vertices);

/// Numbers the vertices of faces by their place in `used`, which has all of them. Cost: as above.
void renumber(std::vector<Face>& faces, const std::vector<std::uint32_t>& used,
              std::size_t num_vertices);

/// Adds a vertex with the place, colour and point of another. Returns its number.
std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original);

/// Adds the middle between two vertices, in their mean colour; it is no point of the scene. Returns
/// its number.
std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b);

/// The center of the bounding box of the vertices; zero if there are none. Cost: O(vertices).
Eigen::Vector3d box_center(const TriMesh& mesh);

/// A mesh with other faces and only the vertices they use, without normals. Cost: O(faces +
/// vertices).
TriMesh with_used_vertices(const TriMesh& mesh, std::vector<Face> faces);

} // namespace vcarve
