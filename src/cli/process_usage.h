#pragma once

#include <sys/time.h>

#include <cstdint>

namespace vcarve::cli {

double seconds_of(const timeval& time);

/// What this process has used so far.
struct ProcessUsage {
    double seconds = 0.0;     ///< on a clock that only runs forward, from an arbitrary zero
    double cpu_seconds = 0.0; ///< of all threads, user and system
};
ProcessUsage process_usage();

/// Most memory the process held at once (VmHWM) since its start or the last reset_peak_memory(); 0
/// where the system does not tell.
std::int64_t peak_memory_bytes();

/// Starts a new peak at what is held now. False where that is not permitted: the peak then goes on
/// being that of the whole run.
bool reset_peak_memory();

} // namespace vcarve::cli
