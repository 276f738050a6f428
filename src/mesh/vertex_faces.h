#pragma once

#include "base/parallel_rows.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vcarve {

using FaceFlags = std::vector<std::uint8_t>; ///< one a face, 0 or 1

/// The faces at each vertex: one row of face numbers a vertex, ascending but where it was replaced.
class VertexFaces {
  public:
    /// Of the faces with a flag only; of all where there are no flags. Cost: O(faces) time, in
    /// parallel, 12 bytes a face and 4 a vertex.
    VertexFaces(std::span<const Face> faces, std::size_t num_vertices, const FaceFlags& flags = {});

    std::span<const std::uint32_t> operator[](std::size_t vertex) const
    {
        if (replaced_.empty()) return table_[vertex];
        const auto row = replaced_.find(static_cast<std::uint32_t>(vertex));
        return row == replaced_.end() ? table_[vertex] : row->second;
    }

    /// Gives a vertex another row.
    void replace(std::uint32_t vertex, std::vector<std::uint32_t> row)
    {
        replaced_[vertex] = std::move(row);
    }

  private:
    RowTable table_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> replaced_; ///< by vertex
};

} // namespace vcarve
