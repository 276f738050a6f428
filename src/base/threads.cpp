#include "base/threads.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

namespace vcarve {

namespace {

int cores_of_affinity_mask()
{
    cpu_set_t mask;
    CPU_ZERO(&mask);
    if (sched_getaffinity(0, sizeof(mask), &mask) == 0) return CPU_COUNT(&mask);
    return static_cast<int>(std::thread::hardware_concurrency());
}

std::optional<double> number_in_file(const char* path)
{
    std::ifstream file(path);
    double number = 0.0;
    if (file >> number) return number;
    return std::nullopt;
}

/// cgroup 2: quota and period in microseconds, "150000 100000", or "max 100000" without a quota.
std::optional<double> cores_of_cgroup_2()
{
    std::ifstream file("/sys/fs/cgroup/cpu.max");
    double quota = 0.0;
    double period = 0.0;
    if (file >> quota >> period && period > 0.0) return quota / period;
    return std::nullopt;
}

/// cgroup 1: a quota of -1 means none.
std::optional<double> cores_of_cgroup_1()
{
    const auto quota = number_in_file("/sys/fs/cgroup/cpu/cpu.cfs_quota_us");
    const auto period = number_in_file("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
    if (quota && period && *quota > 0.0 && *period > 0.0) return *quota / *period;
    return std::nullopt;
}

} // namespace

int available_threads()
{
    int threads = cores_of_affinity_mask();
    for (const auto& quota : {cores_of_cgroup_2(), cores_of_cgroup_1()}) {
        if (quota) threads = std::min(threads, static_cast<int>(std::ceil(*quota)));
    }
    return std::max(threads, 1);
}

} // namespace vcarve
