#pragma once

#include "base/parallel.h"
#include "mesh/edge_table.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

// Corners at one vertex that hang together through sewn half-edges form a fan, or a disk if they
// close. `twins` has the half-edge that each half-edge is sewn to, or kNoHalfEdge at a border.
// Twins run along the same two vertices in opposite directions.

/// The next corner of a fan, clockwise seen from outside; kNoHalfEdge at its end.
inline HalfEdge next_corner(std::span<const HalfEdge> twins, HalfEdge corner)
{
    return twins[corner] == kNoHalfEdge ? kNoHalfEdge : next_half_edge(twins[corner]);
}

/// Calls visit for each corner of the fan of `first`; for none where that is kNoHalfEdge. A disk
/// ends with `first`.
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

/// Any corner of each vertex, not the same one every time; kNoHalfEdge where it has none. Cost:
/// O(faces), in parallel.
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
