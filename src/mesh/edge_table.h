#pragma once

#include "base/arrays.h"
#include "base/parallel.h"
#include "vcarve/tri_mesh.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Half-edge i of face f leads from corner i to corner (i + 1) % 3 and has the number 3 f + i.
/// Corner i has the same number.
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

/// The start vertex (tail) and the end vertex (head) of a half-edge.
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

/// The half-edges of all faces, grouped by edge. Edges are sorted by (lower, higher vertex), and
/// the half-edges of an edge by number.
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

/// Groups half-edges by edge, without degenerate faces (with a repeated vertex). Vertex indices
/// must be below `num_vertices`, and the number of faces below 2^32 / 3. Cost: O(faces log(faces
/// per vertex)) time; 24 bytes per face and 4 per vertex.
EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices);

/// The number of edges with one face for which counts(tail, head) is true. Cost: as gather_edges().
template <typename Counts>
std::int64_t count_boundary_edges(std::span<const Face> faces, std::size_t num_vertices,
                                  const Counts& counts)
{
    const EdgeTable edges = gather_edges(faces, num_vertices);
    std::int64_t count = 0;
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const std::span<const HalfEdge> all = edges[edge];
        const bool is_one = all.size() == 1 && counts(tail(faces, all[0]), head(faces, all[0]));
        count += is_one ? 1 : 0;
    }
    return count;
}

// Corners of a vertex that are connected by twins form a fan, or a disk if they close. `twins` has
// the twin of each half-edge, or kNoHalfEdge on the boundary. Twins connect the same two vertices
// in opposite directions.

/// The next corner of a fan, clockwise seen from outside; kNoHalfEdge at the end of the fan.
inline HalfEdge next_corner(std::span<const HalfEdge> twins, HalfEdge corner)
{
    return twins[corner] == kNoHalfEdge ? kNoHalfEdge : next_half_edge(twins[corner]);
}

/// Calls visit for each corner of the fan of `first`; for none if that is kNoHalfEdge. In a disk,
/// `first` is last.
template <typename Visit>
void for_each_corner_of_fan(std::span<const HalfEdge> twins, HalfEdge first, const Visit& visit)
{
    if (first == kNoHalfEdge) return;
    HalfEdge corner = next_corner(twins, first);
    for (; corner != kNoHalfEdge && corner != first; corner = next_corner(twins, corner)) {
        visit(corner);
    }
    visit(first);
    if (corner == first) return;
    for (corner = twins[previous_half_edge(first)]; corner != kNoHalfEdge;
         corner = twins[previous_half_edge(corner)]) {
        visit(corner);
    }
}

/// An arbitrary corner of each vertex, which may differ between runs; kNoHalfEdge for a vertex
/// without faces. Cost: O(faces), in parallel.
inline std::vector<HalfEdge> corners_of_vertices(std::span<const Face> faces,
                                                 std::size_t num_vertices)
{
    std::vector<HalfEdge> corners(num_vertices, kNoHalfEdge);
    parallel_for(faces.size(), [&](std::size_t face) {
        for (std::size_t i = 0; i < 3; ++i) {
            std::atomic_ref(corners[faces[face][i]])
                .store(static_cast<HalfEdge>(3 * face + i), std::memory_order_relaxed);
        }
    });
    return corners;
}

} // namespace vcarve
