#pragma once

#include "base/unset_array.h"
#include "vcarve/tri_mesh.h"

#include <span>
#include <vector>

namespace vcarve {

/// Half-edge i of face f runs from its corner i to its corner (i + 1) % 3 and has the number
/// 3 f + i; corner i has the same number. So a number names a half-edge and the corner it starts
/// at.
///
///        2
///       / \          half-edge 0: 0 -> 1
///   h2 /   \ h1      half-edge 1: 1 -> 2
///     /_____\        half-edge 2: 2 -> 0
///    0  h0   1
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge kNoHalfEdge = 0xffffffffU;

inline HalfEdge next_half_edge(HalfEdge half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
inline HalfEdge previous_half_edge(HalfEdge half_edge)
{
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// The vertex a half-edge starts at, and the one it ends at.
inline std::uint32_t tail(std::span<const Face> faces, HalfEdge half_edge)
{
    return faces[half_edge / 3][half_edge % 3];
}
inline std::uint32_t head(std::span<const Face> faces, HalfEdge half_edge)
{
    return tail(faces, next_half_edge(half_edge));
}

inline bool is_degenerate(const Face& face)
{
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The half-edges of all faces, gathered by the edge they run along. Edges are in ascending order
/// of (lower, higher vertex), the half-edges of an edge ascend.
struct EdgeTable {
    UnsetArray<HalfEdge> half_edges;
    /// Edge e has half_edges[begins[e]] up to half_edges[begins[e + 1]].
    std::vector<std::uint32_t> begins;

    std::size_t size() const { return begins.size() - 1; }
    std::span<const HalfEdge> operator[](std::size_t edge) const
    {
        return {half_edges.data() + begins[edge], half_edges.data() + begins[edge + 1]};
    }
};

/// Degenerate faces (a vertex twice) are left out. Every index must be below `num_vertices`, and
/// the faces fewer than 2^32 / 3. Cost: O(faces log(faces of a vertex)) time, 24 bytes a face and 4
/// a vertex.
EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices);

} // namespace vcarve
