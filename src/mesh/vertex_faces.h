#pragma once

#include "base/parallel_rows.h"
#include "vcarve/tri_mesh.h"

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

} // namespace vcarve
