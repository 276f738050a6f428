#pragma once

#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

} // namespace vcarve
