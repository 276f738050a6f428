#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace vcarve {

/// The memory of a control group, in bytes.
struct CgroupMemory {
    std::int64_t limit = 0;
    std::int64_t used = 0;  ///< with the system's cache of files
    std::int64_t cache = 0; ///< of that, what the system can take back
    std::int64_t free() const { return limit - used + cache; }
};

/// Of the control groups of this process, version 1 or 2, the one with the least free memory;
/// nothing where none of them has a limit. `root` is where /proc and /sys are.
std::optional<CgroupMemory> cgroup_memory(const std::filesystem::path& root = "/");

/// How much memory the machine or the control group still has for this process, whichever is less,
/// in bytes; nothing where neither says.
std::optional<std::int64_t> free_memory(const std::filesystem::path& root = "/");

/// Gives memory that was freed back to the system. The allocators keep it for later, and what comes
/// next may not fit what they keep: after a parallel triangulation oneTBB's keeps up to 400 bytes a
/// point, after a dense cloud is thinned the C library's 100. Cost: some milliseconds.
void return_freed_memory();

} // namespace vcarve
