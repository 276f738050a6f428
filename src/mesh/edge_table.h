#pragma once

#include "vcarve/tri_mesh.h"

#include <span>
#include <vector>

namespace vcarve {

/// Side i of face f runs from its corner i to its corner (i + 1) % 3 and has the number 3 f + i;
/// corner i has the same number. So a number names a half-edge and the corner it starts at.
///
///        2
///       / \          side 0: 0 -> 1
///   s2 /   \ s1      side 1: 1 -> 2
///     /_____\        side 2: 2 -> 0
///    0  s0   1
using Side = std::uint32_t;
inline constexpr Side kNoSide = 0xffffffffU;

inline Side next_side(Side side)
{
    return side % 3 == 2 ? side - 2 : side + 1;
}
inline Side previous_side(Side side)
{
    return side % 3 == 0 ? side + 2 : side - 1;
}

/// The vertex a side starts at, and the one it ends at.
inline std::uint32_t tail(std::span<const Face> faces, Side side)
{
    return faces[side / 3][side % 3];
}
inline std::uint32_t head(std::span<const Face> faces, Side side)
{
    return tail(faces, next_side(side));
}

inline bool is_degenerate(const Face& face)
{
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The sides of all faces, gathered by the edge they run along. Edges are in ascending order of
/// (lower, higher vertex), the sides of an edge ascend.
struct EdgeTable {
    std::vector<Side> sides;
    std::vector<std::uint32_t> begins; ///< edge e has sides[begins[e]] up to sides[begins[e + 1]]

    std::size_t size() const { return begins.size() - 1; }
    std::span<const Side> operator[](std::size_t edge) const
    {
        return {sides.data() + begins[edge], sides.data() + begins[edge + 1]};
    }
};

/// Degenerate faces (a vertex twice) are left out. Every index must be below `num_vertices`, and
/// the faces fewer than 2^32 / 3. Cost: O(faces log(faces of a vertex)) time, 24 bytes a face and 4
/// a vertex.
EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices);

} // namespace vcarve
