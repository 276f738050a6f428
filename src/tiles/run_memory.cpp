#include "tiles/run_memory.h"

#include "base/free_memory.h"
#include "base/text.h"
#include "tiles/tile_size.h"

#include <fmt/format.h>

namespace vcarve {

std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted)
{
    if (wanted.limit == 0) return std::nullopt;
    if (wanted.limit != MemoryOptions::kAutoMemory) return wanted.limit;
    const std::optional<std::int64_t> free = free_memory();
    if (!free) return std::nullopt;
    return *free / 5 * 4;
}

RunMemory::RunMemory(const MemoryOptions& wanted, std::size_t tile_points, bool one_piece,
                     int threads)
    : is_given_(wanted.limit != MemoryOptions::kAutoMemory),
      one_piece_(one_piece),
      threads_(threads),
      allowed_(allowed_memory(wanted).value_or(0)),
      tile_points_(tile_points)
{
}

void RunMemory::fit(const RunSize& size, Log& log)
{
    needed_ = predicted_peak(size, threads_);
    if (allowed_ == 0 || needed_ <= allowed_) return;
    if (size.measures_dense)
        return require_memory(size, threads_, allowed_); // sparse: in one piece
    if (tile_points_ > 0) return;
    // Points of a cloud are merged while they are read, and their number is known later.
    const bool is_known = size.thinned.points > 0;
    if (!is_known || one_piece_) {
        if (is_given_) require_memory(size, threads_, allowed_);
        return;
    }
    tile_points_ = points_of_tile(size.thinned, size.options, allowed_);
    log.note(fmt::format("about {} needed, {} allowed: tiles of {} points", byte_size_text(needed_),
                         byte_size_text(allowed_),
                         grouped_digits(static_cast<std::int64_t>(tile_points_))));
}

} // namespace vcarve
