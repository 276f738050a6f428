#pragma once

#include <sys/time.h>

#include <cstdint>

namespace vcarve {

double seconds_of(const timeval& time);

/// The time that this process has used so far.
struct ProcessUsage {
    double seconds = 0.0;     ///< of a monotonic clock with an arbitrary zero
    double cpu_seconds = 0.0; ///< of all threads, user and system
};
ProcessUsage process_usage();

/// Peak memory of the process (VmHWM) since its start or the last reset_peak_memory(); 0 if
/// unknown.
std::int64_t peak_memory_bytes();

/// Resets the peak. Returns false if the system does not permit it.
bool reset_peak_memory();

} // namespace vcarve
