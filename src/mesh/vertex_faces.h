#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

using FaceFlags = std::vector<std::uint8_t>; ///< one a face, 0 or 1

/// The faces at each vertex: one row of face numbers a vertex, ascending.
class VertexFaces {
  public:
    /// Of the faces with a flag only; of all where there are no flags. Cost: O(faces) time, 12
    /// bytes a face and 4 a vertex.
    VertexFaces(std::span<const Face> faces, std::size_t num_vertices, const FaceFlags& flags = {});

    std::span<const std::uint32_t> operator[](std::size_t vertex) const
    {
        const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
        return {faces_.data() + begin, faces_.data() + ends_[vertex]};
    }

  private:
    std::vector<std::uint32_t> ends_;
    std::vector<std::uint32_t> faces_;
};

} // namespace vcarve
