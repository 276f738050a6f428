#pragma once

#include "base/parallel_rows.h"
#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

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

} // namespace vcarve
