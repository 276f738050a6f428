#include "base/free_memory.h"

#include <tbb/scalable_allocator.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace vcarve {

namespace {

namespace fs = std::filesystem;

/// The number in a file that contains only a number; nothing for other content, such as "max".
std::optional<std::int64_t> number_in(const fs::path& path)
{
    std::ifstream file(path);
    std::int64_t number = 0;
    if (file >> number) return number;
    return std::nullopt;
}

/// The number after `word`, in a file of pairs of a word and a number.
std::optional<std::int64_t> number_behind(std::string_view word, const fs::path& path)
{
    std::ifstream file(path);
    for (std::string found; file >> found;) {
        std::int64_t number = 0;
        if (found == word && file >> number) return number;
    }
    return std::nullopt;
}

/// The file names of one cgroup version.
struct CgroupNames {
    std::string_view controllers; ///< the field of /proc/self/cgroup
    std::string_view mounted;     ///< the usual folder of the root group
    std::string_view limit;
    std::string_view used;
    std::string_view cache; ///< the key in memory.stat, for a group and its descendants
};
constexpr CgroupNames kVersions[] = {
    {"", "sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"},
    {"memory", "sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
     "total_inactive_file"},
};

/// The path of this process's group without the leading slash: "a/b" for "4:memory:/a/b".
std::optional<fs::path> group_of(const CgroupNames& names, const fs::path& root)
{
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        if (line.substr(first + 1, second - first - 1) != names.controllers) continue;
        return fs::path(line.substr(second + 1)).relative_path();
    }
    return std::nullopt;
}

std::optional<CgroupMemory> memory_of(const fs::path& group, const CgroupNames& names)
{
    const auto limit = number_in(group / names.limit);
    const auto used = number_in(group / names.used);
    // Version 1 expresses "no limit" as a huge number.
    constexpr std::int64_t kNoLimit = std::int64_t{1} << 60;
    if (!limit || !used || *limit >= kNoLimit) return std::nullopt;
    const auto cache = number_behind(names.cache, group / "memory.stat");
    return CgroupMemory{.limit = *limit, .used = *used, .cache = cache.value_or(0)};
}

std::optional<CgroupMemory> lesser(const std::optional<CgroupMemory>& one,
                                   const std::optional<CgroupMemory>& other)
{
    if (!one || !other) return one ? one : other;
    return one->free() <= other->free() ? one : other;
}

} // namespace

std::optional<CgroupMemory> cgroup_memory(const fs::path& root)
{
    std::optional<CgroupMemory> least;
    for (const CgroupNames& names : kVersions) {
        std::optional<fs::path> group = group_of(names, root);
        if (!group) continue;
        // Ancestors limit a group, too. The root is checked last: a container sees its own group
        // as the root, whatever the path is.
        while (!group->empty()) {
            least = lesser(least, memory_of(root / names.mounted / *group, names));
            group = group->parent_path();
        }
        least = lesser(least, memory_of(root / names.mounted, names));
    }
    return least;
}

std::optional<std::int64_t> free_memory(const fs::path& root)
{
    constexpr std::int64_t kKilobyte = 1024;
    std::optional<std::int64_t> free;
    if (const auto kilobytes = number_behind("MemAvailable:", root / "proc/meminfo")) {
        free = *kilobytes * kKilobyte;
    }
    if (const auto cgroup = cgroup_memory(root)) {
        const std::int64_t of_cgroup = std::max(cgroup->free(), std::int64_t{0});
        free = free ? std::min(*free, of_cgroup) : of_cgroup;
    }
    return free;
}

void return_freed_memory()
{
    scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace vcarve
