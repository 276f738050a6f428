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

/// The corner of a face at a vertex; 3 if the vertex is not in the face.
inline std::size_t corner_of(const Face& face, std::uint32_t vertex)
{
    return static_cast<std::size_t>(std::ranges::find(face, vertex) - face.begin());
}

/// Returns a face with the vertex `corner` replaced by `other`.
inline Face with(Face face, std::uint32_t corner, std::uint32_t other)
{
    std::ranges::replace(face, corner, other);
    return face;
}

/// Rotates a face so that the vertex `corner` is first.
inline Face turned_to(const Face& face, std::uint32_t corner)
{
    if (face[0] == corner) return face;
    if (face[1] == corner) return {face[1], face[2], face[0]};
    return {face[2], face[0], face[1]};
}

using FaceFlags = std::vector<std::uint8_t>; ///< per face, 0 or 1

/// The faces of each vertex: rows of ascending face indices.
class VertexFaces {
  public:
    /// Includes only flagged faces, or all if `flags` is empty. Cost: O(faces), in parallel; 12
    /// bytes per face and 4 per vertex.
    VertexFaces(std::span<const Face> faces, std::size_t num_vertices, const FaceFlags& flags = {});

    std::span<const std::uint32_t> operator[](std::size_t vertex) const { return table_[vertex]; }

  private:
    RowTable table_;
};

inline constexpr std::array<int, 3> kCorners = {0, 1, 2}; ///< of a face

/// Calls visit(other) for the other faces in `faces_at` that contain the edge from a corner of a
/// face to the next one, in either direction. Cost: O(faces at the corner).
template <typename Visit>
void visit_beside(std::span<const Face> faces, std::uint32_t face, int corner,
                  const VertexFaces& faces_at, const Visit& visit)
{
    const std::uint32_t to = faces[face][(corner + 1) % 3];
    for (const std::uint32_t other : faces_at[faces[face][corner]]) {
        if (other != face && std::ranges::count(faces[other], to) > 0) visit(other);
    }
}

/// The vertices of faces, ascending. Cost: O(faces + vertices), in parallel.
std::vector<std::uint32_t> used_vertices(const std::vector<Face>& faces, std::size_t num_vertices);

/// Replaces vertices by their index in `used`, which must contain them all. Cost: as above.
void renumber(std::vector<Face>& faces, const std::vector<std::uint32_t>& used,
              std::size_t num_vertices);

/// Adds a copy of a vertex: its position, color and point. Returns the new index.
std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original);

/// Adds the midpoint of two vertices, with their mean color and no point of the scene. Returns the
/// new index.
std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b);

/// The center of the bounding box; zero for a mesh without vertices. Cost: O(vertices).
Eigen::Vector3d box_center(const TriMesh& mesh);

/// Returns a mesh of the given faces and only their vertices, without normals. Cost: O(faces +
/// vertices).
TriMesh with_used_vertices(const TriMesh& mesh, std::vector<Face> faces);

} // namespace vcarve
