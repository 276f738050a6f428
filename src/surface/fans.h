#pragma once

#include "surface/edge_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Corners at one vertex that hang together through sewn sides form a fan, or a disk if they close.
/// `mates` has the side that each side is sewn to, or kNoSide at a border. Sewn sides run along the
/// same two vertices in opposite directions.

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

/// How many corners there are at each vertex, and which one is the last.
class VertexCorners {
  public:
    VertexCorners(std::span<const Face> faces, std::size_t num_vertices) : entries_(num_vertices)
    {
        for (std::size_t face = 0; face < faces.size(); ++face) {
            for (std::size_t i = 0; i < 3; ++i) {
                Entry& entry = entries_[faces[face][i]];
                entry.last = static_cast<Side>(3 * face + i);
                ++entry.count;
            }
        }
    }

    Side last(std::size_t vertex) const { return entries_[vertex].last; } ///< or kNoSide
    std::uint32_t count(std::size_t vertex) const { return entries_[vertex].count; }

  private:
    struct Entry {
        Side last = kNoSide;
        std::uint32_t count = 0;
    };
    std::vector<Entry> entries_;
};

} // namespace vcarve
