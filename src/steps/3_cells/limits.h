#pragma once

#include "vcarve/error.h"

#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace vcarve {

/// Throws InputError where so few points are left that they have no tetrahedron. `losses` ends the
/// sentence: why the others are gone.
void require_four_points(std::size_t num_points, std::string_view losses = {});

/// What is thrown where the points do not span space.
InputError all_in_one_plane(std::size_t num_points);

/// What is thrown where the points have more cells than the memory that is allowed holds.
InputError too_many_cells(std::size_t most);

/// What is thrown where two points are the same, which no caller must let happen.
std::logic_error two_at_one_place();

/// How many cells there may be while they are made. Usually a point has some seven; those on two
/// lines that do not meet have as many as pairs of points.
struct CellLimit {
    std::size_t most = std::numeric_limits<std::size_t>::max();
    bool counts_made = true; ///< those of blocks that are done, too: they are in memory
};

/// The cells of all triangulations that grow at a time. From any thread.
class CellCount {
  public:
    explicit CellCount(const CellLimit& limit) : limit_(limit) {}

    /// `before` cells became `now`. Throws InputError where these are too many.
    void change(std::size_t before, std::size_t now)
    {
        const std::size_t more = now - before; // modulo 2^64 where they became fewer
        if (count_.fetch_add(more, std::memory_order_relaxed) + more > limit_.most) {
            throw too_many_cells(limit_.most);
        }
    }
    /// A block with so many cells is done, and keeps some of them.
    void end(std::size_t cells, std::size_t kept) { change(cells, limit_.counts_made ? kept : 0); }

  private:
    CellLimit limit_;
    std::atomic<std::size_t> count_ = 0;
};

} // namespace vcarve
