#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

/// Parallel loops with threads of the standard library, used by parallel.h only in ThreadSanitizer
/// builds. Debian's libtbb is not instrumented: ThreadSanitizer would not see its synchronization,
/// and would report every loop. With these threads, it sees that code before and after a loop is
/// ordered, and that two bodies are not.
namespace vcarve::watched {

/// Whether this thread is running a body. Nested loops run on this thread only.
inline bool& is_in_body()
{
    thread_local bool is_in_body = false;
    return is_in_body;
}

/// Stores the first exception of several threads.
class FirstFailure {
  public:
    template <typename Work>
    void guard(const Work& work)
    {
        const bool before = std::exchange(is_in_body(), true);
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
        is_in_body() = before;
    }
    void rethrow() const
    {
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    std::mutex mutex_;
    std::exception_ptr failure_;
};

/// Like parallel_for_ranges.
template <typename Body>
void for_ranges(std::size_t count, const Body& body, std::size_t grain)
{
    // Relaxed, so that fetching a range does not order the bodies.
    std::atomic<std::size_t> next = 0;
    FirstFailure failure;
    const auto work = [&] {
        failure.guard([&] {
            for (;;) {
                const std::size_t first = next.fetch_add(grain, std::memory_order_relaxed);
                if (first >= count) return;
                body(first, std::min(count, first + grain));
            }
        });
    };
    const int threads = is_in_body() ? 1 : tbb::this_task_arena::max_concurrency();
    std::vector<std::thread> others;
    for (int i = 1; i < threads && count > grain; ++i) {
        others.emplace_back(work);
    }
    work();
    for (std::thread& other : others) {
        other.join();
    }
    failure.rethrow();
}

} // namespace vcarve::watched
