#pragma once

#include "cli/mesh_arguments.h"
#include "cli/run_record.h"
#include "pipeline/memory.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace vcarve::cli {

/// The memory limit in bytes: as given, or 80 % of the free memory. Nothing if unlimited.
std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted);

/// A unique path beside the output, or in the temporary folder if the output is a device.
std::filesystem::path folder_beside(const std::filesystem::path& out);

/// Decides whether a model is meshed in one piece or in tiles.
class RunMemory {
  public:
    RunMemory(const MeshArguments& arguments, int threads);

    /// Decides for a size; called again when it is known better. Tiles are noted once, and kept.
    /// Throws InputError if the memory is insufficient.
    void fit(const RunSize& size, Log& log);

    /// The maximum number of points of a tile; 0 in one piece.
    std::size_t tile_points() const { return tile_points_; }
    /// {"tile_points", "needed_bytes", "allowed_bytes"}; the second is of a run in one piece.
    Json record() const;

  private:
    const MeshArguments& arguments_;
    int threads_;
    std::int64_t allowed_; ///< bytes; 0 if unlimited
    std::int64_t needed_ = 0;
    std::size_t tile_points_;
};

} // namespace vcarve::cli
