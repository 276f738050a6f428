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

/// No maximum number of cells. There are usually about seven per point; points on two skew lines
/// have as many cells as pairs of points.
inline constexpr std::size_t kAnyCells = std::numeric_limits<std::size_t>::max();

/// Counts the cells of finished blocks and of all triangulations in progress. Thread-safe.
class CellCount {
  public:
    explicit CellCount(std::size_t most) : most_(most) {}

    /// Replaces `before` cells by `now`. Throws InputError above the maximum.
    void change(std::size_t before, std::size_t now)
    {
        const std::size_t more = now - before; // modulo 2^64 if the number decreases
        if (count_.fetch_add(more, std::memory_order_relaxed) + more > most_) {
            throw too_many_cells(most_);
        }
    }

  private:
    std::size_t most_;
    std::atomic<std::size_t> count_ = 0;
};

} // namespace vcarve
