#pragma once

#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// The vertices that faces use, ascending. Cost: O(faces + vertices), in parallel.
std::vector<std::uint32_t> used_vertices(const std::vector<Face>& faces, std::size_t num_vertices);

/// Numbers the vertices of faces by their place in `used`, which has all of them. Cost: as above.
void renumber(std::vector<Face>& faces, const std::vector<std::uint32_t>& used,
              std::size_t num_vertices);

} // namespace vcarve
