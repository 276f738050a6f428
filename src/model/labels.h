#pragma once

#include <cstdint>
#include <vector>

namespace vcarve {

/// What a cell is taken for.
enum class Label : std::uint8_t { outside = 0, inside = 1 };

/// One label a cell of a TetMesh.
using Labels = std::vector<Label>;

} // namespace vcarve
