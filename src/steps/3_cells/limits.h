#pragma once

#include "vcarve/error.h"

#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace vcarve {

/// The error for points that have no surface, such as few points. A tile of a large model (tiles/)
/// may have none.
class NoSurface final : public InputError {
  public:
    using InputError::InputError;
};

/// Throws NoSurface if fewer than four points are left, which have no tetrahedron. The message
/// ends with `losses`, the reason for dropped points.
void require_four_points(std::size_t num_points, std::string_view losses = {});

/// The error for coplanar points.
NoSurface all_in_one_plane(std::size_t num_points);

/// The error for more cells than fit in the allowed memory.
InputError too_many_cells(std::size_t most);

/// The error for coincident points, which callers must prevent.
std::logic_error duplicate_position_error();

/// The maximum number of cells during a triangulation. There are usually about seven per point.
/// Points on two skew lines have as many cells as pairs of points.
struct CellLimit {
    std::size_t limit = std::numeric_limits<std::size_t>::max();
    bool counts_made = true; ///< count cells of finished blocks, which are in memory
};

/// Counts the cells of all triangulations in progress. Thread-safe.
class CellCount {
  public:
    explicit CellCount(const CellLimit& limit) : limit_(limit) {}

    /// Replaces `before` cells by `now`. Throws InputError above the limit.
    void change(std::size_t before, std::size_t now)
    {
        const std::size_t more = now - before; // modulo 2^64 if the number decreases
        if (count_.fetch_add(more, std::memory_order_relaxed) + more > limit_.limit) {
            throw too_many_cells(limit_.limit);
        }
    }
    /// Records that a block of `cells` cells is finished and keeps `kept` of them.
    void end(std::size_t cells, std::size_t kept) { change(cells, limit_.counts_made ? kept : 0); }

  private:
    CellLimit limit_;
    std::atomic<std::size_t> count_ = 0;
};

} // namespace vcarve
