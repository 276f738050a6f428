#pragma once

#include "base/progress.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#ifdef VCARVE_WATCHES_THREADS
#include "base/watched_loops.h"
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>
#endif

namespace vcarve {

/// The thread count of the current tbb arena.
inline std::size_t num_threads()
{
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

/// Calls body(first, last) for ranges [first, last) that partition [0, count), on all threads of
/// the current tbb arena. Ranges have about `grain` elements or more. The result of the body must
/// not depend on the partition.
template <typename Body>
void parallel_for_ranges(std::size_t count, const Body& body, std::size_t grain = 1024)
{
#ifdef VCARVE_WATCHES_THREADS
    watched::for_ranges(count, body, grain);
#else
    using Range = tbb::blocked_range<std::size_t>;
    tbb::parallel_for(Range(0, count, grain),
                      [&](const Range& range) { body(range.begin(), range.end()); });
#endif
}

/// Calls body(i) for every i in [0, count), on all threads of the current tbb arena. The body must
/// not depend on the order of the calls.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1024)
{
    const auto run = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            body(i);
        }
    };
    parallel_for_ranges(count, run, grain);
}

/// Like parallel_for_ranges above, but with ranges of at most `grain` elements, and reports each
/// finished range to `progress`. Throws Cancelled if the run should stop.
template <typename Body>
void parallel_for_ranges(std::size_t count, const Progress& progress, const Body& body,
                         std::size_t grain = 1024)
{
    ProgressCount done(progress, count);
    const auto run = [&](std::size_t first, std::size_t last) {
        for (std::size_t begin = first; begin < last; begin += grain) {
            const std::size_t end = std::min(last, begin + grain);
            body(begin, end);
            done.add(end - begin);
        }
    };
    parallel_for_ranges(count, run, grain);
}

/// Like parallel_for above, but reports the number of finished elements to `progress`. Throws
/// Cancelled if the run should stop.
template <typename Body>
void parallel_for(std::size_t count, const Progress& progress, const Body& body,
                  std::size_t grain = 1024)
{
    const auto run = [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            body(i);
        }
    };
    parallel_for_ranges(count, progress, run, grain);
}

/// Calls body(i, items) for every i in [0, count) with an empty list, which is allocated once per
/// range (parallel_for_ranges). The body must not depend on the order of the calls.
template <typename Item, typename Body>
void parallel_for_with_list(std::size_t count, const Body& body, std::size_t grain = 1024)
{
    const auto run = [&](std::size_t first, std::size_t last) {
        std::vector<Item> items;
        for (std::size_t i = first; i != last; ++i) {
            items.clear();
            body(i, items);
        }
    };
    parallel_for_ranges(count, run, grain);
}

/// Returns the items that visit(i, items) appends for every i in [0, count), in the order of i.
/// Uses all threads of the current tbb arena. Reports each block of `grain` calls to `progress`.
/// Throws Cancelled if the run should stop. Needs twice the memory of the result.
template <typename Item, typename Visit>
std::vector<Item> parallel_collect(std::size_t count, const Progress& progress, const Visit& visit,
                                   std::size_t grain = 16384)
{
    std::vector<std::vector<Item>> blocks((count + grain - 1) / grain);
    parallel_for(
        blocks.size(), progress,
        [&](std::size_t block) {
            std::vector<Item> items;
            for (std::size_t i = block * grain; i < std::min(count, (block + 1) * grain); ++i) {
                visit(i, items);
            }
            blocks[block] = std::move(items);
        },
        1);

    std::vector<std::size_t> begins{0};
    for (const std::vector<Item>& block : blocks) {
        begins.push_back(begins.back() + block.size());
    }
    std::vector<Item> all(begins.back());
    parallel_for(
        blocks.size(),
        [&](std::size_t block) {
            std::ranges::copy(blocks[block],
                              all.begin() + static_cast<std::ptrdiff_t>(begins[block]));
            std::vector<Item>().swap(blocks[block]);
        },
        1);
    return all;
}

/// The same without progress.
template <typename Item, typename Visit>
std::vector<Item> parallel_collect(std::size_t count, const Visit& visit, std::size_t grain = 16384)
{
    return parallel_collect<Item>(count, Progress(), visit, grain);
}

/// The sum of value(i) over i in [0, count), with `plus` as addition and `zero` as neutral element.
/// Adds runs of 1024 values in order, then the sums of the runs in order. So the result does not
/// depend on the thread count, even if `plus` depends on the order.
template <typename Sum, typename Value, typename Plus = std::plus<>>
Sum parallel_sum(std::size_t count, const Sum& zero, const Value& value, const Plus& plus = {})
{
    constexpr std::size_t kRun = 1024;
    std::vector<Sum> runs((count + kRun - 1) / kRun, zero);
    parallel_for(
        runs.size(),
        [&](std::size_t run) {
            for (std::size_t i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) {
                runs[run] = plus(runs[run], value(i));
            }
        },
        1);
    Sum sum = zero;
    for (const Sum& run : runs) {
        sum = plus(sum, run);
    }
    return sum;
}

/// The number of i in [0, count) for which is_so(i) is true. Calls is_so like parallel_for().
template <typename Predicate>
std::size_t parallel_count(std::size_t count, const Predicate& is_so, std::size_t grain = 1024)
{
    std::atomic<std::size_t> counted = 0;
    const auto run = [&](std::size_t first, std::size_t last) {
        std::size_t of_range = 0;
        for (std::size_t i = first; i != last; ++i) {
            of_range += is_so(i) ? 1 : 0;
        }
        counted += of_range;
    };
    parallel_for_ranges(count, run, grain);
    return counted;
}

/// Calls both functions, concurrently if the current tbb arena has an idle thread.
template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second)
{
#ifdef VCARVE_WATCHES_THREADS
    watched::for_ranges(
        2, [&](std::size_t i, std::size_t) { i == 0 ? first() : second(); }, 1);
#else
    tbb::parallel_invoke(first, second);
#endif
}

/// Sorts a vector on all threads of the current tbb arena. `less` must order any two
/// distinguishable elements, else the result depends on the threads.
template <typename Items, typename Less = std::less<>>
void parallel_sort(Items& items, const Less& less = {})
{
#ifdef VCARVE_WATCHES_THREADS
    std::sort(items.begin(), items.end(), less); // see watched_loops.h
#else
    tbb::parallel_sort(items.begin(), items.end(), less);
#endif
}

/// Sets `least` to `value` if that is smaller. Threads may do so concurrently: the smallest value
/// remains, in whatever order they come.
template <typename Number>
void atomic_min(Number& least, Number value)
{
    const std::atomic_ref<Number> shared(least);
    Number seen = shared.load(std::memory_order_relaxed);
    while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

} // namespace vcarve
