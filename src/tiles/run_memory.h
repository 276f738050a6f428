#pragma once

#include "pipeline/memory.h"
#include "vcarve/log.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace vcarve {

/// The memory limit in bytes: as given, or 80 % of the free memory. Nothing if unlimited.
std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted);

/// Decides whether a model is meshed in one piece or in tiles.
class RunMemory {
  public:
    /// `tile_points` is the maximum number of points of a tile, 0 if memory decides. Models that
    /// need `one_piece` are never divided.
    RunMemory(const MemoryOptions& wanted, std::size_t tile_points, bool one_piece, int threads);

    /// Decides for a size; called again when it is known better. Tiles are noted once, and kept.
    /// Throws InputError if the memory is insufficient.
    void fit(const RunSize& size, Log& log);

    /// The maximum number of points of a tile; 0 in one piece.
    std::size_t tile_points() const { return tile_points_; }
    /// Bytes of a run in one piece.
    std::int64_t needed() const { return needed_; }
    /// The limit in bytes; 0 if unlimited.
    std::int64_t allowed() const { return allowed_; }

  private:
    bool is_given_;
    bool one_piece_;
    int threads_;
    std::int64_t allowed_;
    std::int64_t needed_ = 0;
    std::size_t tile_points_;
};

} // namespace vcarve
