#include "cli/run_memory.h"

#include "base/free_memory.h"
#include "base/text.h"
#include "tiles/tile_size.h"

#include <fmt/format.h>
#include <unistd.h>

namespace vcarve::cli {

namespace fs = std::filesystem;

fs::path folder_beside(const fs::path& out)
{
    std::error_code error;
    const bool is_device = fs::is_character_file(out, error);
    fs::path folder = is_device ? fs::temp_directory_path(error) / "colmap-vcarve" : out;
    folder += fmt::format(".tiles-{}", ::getpid());
    return folder;
}

std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted)
{
    if (wanted.limit == 0) return std::nullopt;
    if (wanted.limit != MemoryOptions::kAutoMemory) return wanted.limit;
    const std::optional<std::int64_t> free = free_memory();
    if (!free) return std::nullopt;
    return *free / 5 * 4;
}

RunMemory::RunMemory(const MeshArguments& arguments, int threads)
    : arguments_(arguments),
      threads_(threads),
      allowed_(allowed_memory(arguments.options.memory).value_or(0)),
      tile_points_(static_cast<std::size_t>(arguments.tile_points))
{
}

void RunMemory::fit(const RunSize& size, Log& log)
{
    needed_ = predicted_peak(size, threads_);
    if (tile_points_ > 0 || allowed_ == 0 || needed_ <= allowed_) return;
    // Points of a cloud are merged while they are read, and their number is known later.
    const bool is_known = size.thinned.points > 0;
    if (!is_known || option_of_one_piece(arguments_) != nullptr) {
        require_memory(size, threads_, arguments_.options.memory.limit);
        return;
    }
    tile_points_ = points_of_tile(size.thinned, arguments_.options, allowed_);
    log.note(fmt::format("about {} needed, {} allowed: tiles of {} points", byte_size_text(needed_),
                         byte_size_text(allowed_),
                         grouped_digits(static_cast<std::int64_t>(tile_points_))));
}

Json RunMemory::record() const
{
    return {{"tile_points", tile_points_}, {"needed_bytes", needed_}, {"allowed_bytes", allowed_}};
}

} // namespace vcarve::cli
