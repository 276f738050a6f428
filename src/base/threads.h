#pragma once

namespace vcarve {

/// The number of threads that can run concurrently, at least 1. Counts the cores in the process's
/// affinity mask, but at most the CPU quota of its control group (cgroup 1 or 2), rounded up.
int available_threads();

/// The thread count for an option's value; 0 means all available threads.
inline int threads_or_all(int wanted)
{
    return wanted == 0 ? available_threads() : wanted;
}

} // namespace vcarve
