#pragma once

#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// Adds a vertex with the place, colour and point of another. Returns its number.
std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original);

/// Adds the middle between two vertices, in their mean colour; it is no point of the scene. Returns
/// its number.
std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b);

} // namespace vcarve
