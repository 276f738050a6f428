#pragma once

namespace vcarve {

/// How many threads can run at once: the cores this process may use (its affinity mask), and no
/// more than the processor time its control group is given (cgroup 1 and 2), rounded up. At
/// least 1.
int available_threads();

/// The number of threads that an option asks for: 0 means all.
inline int threads_or_all(int wanted)
{
    return wanted == 0 ? available_threads() : wanted;
}

} // namespace vcarve
