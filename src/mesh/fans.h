#pragma once

#include "base/parallel.h"
#include "mesh/edge_table.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

// Corners at one vertex that hang together through sewn sides form a fan, or a disk if they close.
// `mates` has the side that each side is sewn to, or kNoSide at a border. Sewn sides run along the
// same two vertices in opposite directions.

/// The next corner of a fan, clockwise seen from outside; kNoSide at its end.
inline Side next_corner(std::span<const Side> mates, Side corner)
{
    return mates[corner] == kNoSide ? kNoSide : next_side(mates[corner]);
}

/// Calls visit for each corner of the fan of `first`; for none where that is kNoSide. A disk ends
/// with `first`.
template <typename Visit>
void for_each_corner_of_fan(std::span<const Side> mates, Side first, const Visit& visit)
{
    if (first == kNoSide) return;
    Side corner = next_corner(mates, first);
    for (; corner != kNoSide && corner != first; corner = next_corner(mates, corner)) {
        visit(corner);
    }
    visit(first);
    if (corner == first) return;
    for (corner = mates[previous_side(first)]; corner != kNoSide;
         corner = mates[previous_side(corner)]) {
        visit(corner);
    }
}

/// Any corner of each vertex, not the same one every time; kNoSide where it has none. Cost:
/// O(faces), in parallel.
inline std::vector<Side> corners_of_vertices(std::span<const Face> faces, std::size_t num_vertices)
{
    std::vector<Side> corners(num_vertices, kNoSide);
    parallel_for(faces.size(), [&](std::size_t face) {
        for (std::size_t i = 0; i < 3; ++i) {
            std::atomic_ref(corners[faces[face][i]])
                .store(static_cast<Side>(3 * face + i), std::memory_order_relaxed);
        }
    });
    return corners;
}

} // namespace vcarve
