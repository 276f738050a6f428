#include "base/process_usage.h"

#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <string>

namespace vcarve {

double seconds_of(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ProcessUsage process_usage()
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return {.seconds = std::chrono::duration<double>(now).count(),
            .cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
}

std::int64_t peak_memory_bytes()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::int64_t kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
    }
    return 0;
}

bool reset_peak_memory()
{
    // proc(5): writing 5 sets the peak to the present resident size.
    std::ofstream clear_refs("/proc/self/clear_refs");
    clear_refs << 5 << std::flush;
    return clear_refs.good();
}

} // namespace vcarve
