#include "base/resident_limit.h"

#include "base/droppable_pages.h"
#include "base/free_memory.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace vcarve {

namespace {

/// Whether less than a quarter of the cgroup's memory is unused, so that pages are reclaimed soon.
bool is_cgroup_nearly_full()
{
    const std::optional<CgroupMemory> cgroup = cgroup_memory();
    return cgroup && cgroup->limit - cgroup->used < cgroup->limit / 4;
}

/// Visited pages may not be in memory, so the resident size is read again after every piece.
void drop_down_to(ResidentSize now, std::int64_t most, bool writes_back)
{
    constexpr std::size_t kAtOnce = std::size_t{64} << 20;
    constexpr int kMostPieces = 256;
    const std::int64_t target = now.all - bytes_to_drop(now, most);
    for (int piece = 0; piece < kMostPieces && now.all > target; ++piece) {
        if (drop_next_pages(kAtOnce, writes_back) == 0) return;
        now = resident_size().value_or(ResidentSize());
    }
}

/// Raises the priority of this thread, if the process is permitted to. Other threads fill memory
/// while it waits for a processor. It sleeps most of the time.
void go_first()
{
#ifdef __linux__
    constexpr int kFirst = -15;
    static_cast<void>(::setpriority(PRIO_PROCESS, 0, kFirst)); // per thread on Linux
#endif
}

} // namespace

std::optional<ResidentSize> resident_size()
{
    const int statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (statm < 0) return std::nullopt;
    std::array<char, 128> text{};
    const ssize_t count = ::read(statm, text.data(), text.size() - 1);
    ::close(statm);
    long long all = 0;
    long long of_files = 0;
    if (count <= 0 || std::sscanf(text.data(), "%*s %lld %lld", &all, &of_files) != 2) {
        return std::nullopt;
    }
    const std::int64_t page = ::sysconf(_SC_PAGESIZE);
    return ResidentSize{.all = all * page, .of_files = of_files * page};
}

std::int64_t bytes_to_drop(const ResidentSize& now, std::int64_t most)
{
    // Threads load more pages between two checks and while pages are dropped. The margin above the
    // upper end allows for this: a quarter of the limit was observed with many busy processes.
    const std::int64_t upper_end = most / 8 * 5;
    const std::int64_t lower_end = most / 2;
    const std::int64_t least_left = most / 8;
    if (now.all <= upper_end) return 0;
    return std::clamp(now.all - lower_end, std::int64_t{0},
                      std::max(now.of_files - least_left, std::int64_t{0}));
}

ResidentLimit::ResidentLimit(std::int64_t most) : most_(most), thread_([this] { watch(); }) {}

ResidentLimit::~ResidentLimit()
{
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    ends_.notify_all();
    thread_.join();
}

/// Sleeps for `pause`. Returns false if the object is being destroyed.
bool ResidentLimit::waits(std::chrono::milliseconds pause)
{
    std::unique_lock lock(mutex_);
    return !ends_.wait_for(lock, pause, [this] { return is_over_; });
}

void ResidentLimit::watch()
{
    constexpr std::chrono::milliseconds kUsual(20);
    constexpr std::chrono::milliseconds kNearLimit(3);
    constexpr std::chrono::milliseconds kLooksAtCgroup(200);
    go_first();
    bool writes_back = false;
    std::chrono::milliseconds since_cgroup = kLooksAtCgroup;
    std::chrono::milliseconds pause = kUsual;
    while (waits(pause)) {
        since_cgroup += pause;
        if (since_cgroup >= kLooksAtCgroup) {
            writes_back = is_cgroup_nearly_full();
            since_cgroup = {};
        }
        const std::optional<ResidentSize> now = resident_size();
        if (now) drop_down_to(*now, most_, writes_back);
        pause = now && now->all > most_ / 2 ? kNearLimit : kUsual;
    }
}

} // namespace vcarve
