#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace vcarve {

/// The memory of a control group (cgroup), in bytes.
struct CgroupMemory {
    std::int64_t limit = 0;
    std::int64_t used = 0;  ///< includes the page cache
    std::int64_t cache = 0; ///< the reclaimable part of the page cache
    std::int64_t free() const { return limit - used + cache; }
};

/// The control group with the least free memory: that of this process (cgroup 1 or 2), or one of
/// its ancestors. Nothing if no group has a limit. `root` is the folder of /proc and /sys.
std::optional<CgroupMemory> cgroup_memory(const std::filesystem::path& root = "/");

/// The free memory of the machine or of the control group, whichever is less, in bytes; nothing if
/// both are unknown.
std::optional<std::int64_t> free_memory(const std::filesystem::path& root = "/");

/// Returns freed memory to the system. Allocators keep it, but later allocations may not fit into
/// it. oneTBB's keeps up to 400 bytes per point after a parallel triangulation. The C library's
/// keeps 100 after a dense cloud is thinned. Cost: some milliseconds.
void return_freed_memory();

} // namespace vcarve
