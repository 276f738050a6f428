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

/// How many threads the surrounding tbb arena has.
inline std::size_t num_threads()
{
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

/// Calls body(first, last) for ranges [first, last) that make up [0, count), each of `grain` or a
/// few more, from as many threads as the surrounding tbb arena has. The body must not depend on how
/// the ranges are cut.
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

/// Calls body(i) for every i in [0, count), from as many threads as the surrounding tbb arena has.
/// The body must not depend on the order of the calls.
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

/// As parallel_for_ranges, with ranges of at most `grain`, after each of which `progress` is told
/// how many are done. It ends early, by throwing Cancelled, where the run is to stop.
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

/// As parallel_for, and tells `progress` how many are done. It ends early, by throwing Cancelled,
/// where the run is to stop.
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

/// Calls body(i, items) for every i in [0, count) with an empty list, which is allocated once a
/// range of `grain`. The body must not depend on the order of the calls.
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

/// What visit(i, items) appends to `items` for the i in [0, count), in the order of i, from as many
/// threads as the surrounding tbb arena has. A thread visits `grain` of them at a time, after which
/// `progress` is told how many are done; it ends early, by throwing Cancelled, where the run is to
/// stop. Needs the memory of the result twice.
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

/// The same, which tells nobody.
template <typename Item, typename Visit>
std::vector<Item> parallel_collect(std::size_t count, const Visit& visit, std::size_t grain = 16384)
{
    return parallel_collect<Item>(count, Progress(), visit, grain);
}

/// The sum over i in [0, count) of value(i), by `plus` from `zero`: within runs of 1024 in the
/// order of i, then over the runs. So it is the same for any number of threads, also where it
/// depends on the order.
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

/// Of how many i in [0, count) is_so(i) holds, asked as parallel_for() does.
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

/// Calls both, side by side where the surrounding tbb arena has a thread to spare.
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

/// Sorts a vector from as many threads as the surrounding tbb arena has. `less` must order any two
/// elements that can be told apart, or the result depends on the threads.
template <typename Items, typename Less = std::less<>>
void parallel_sort(Items& items, const Less& less = {})
{
#ifdef VCARVE_WATCHES_THREADS
    std::sort(items.begin(), items.end(), less); // see watched_loops.h
#else
    tbb::parallel_sort(items.begin(), items.end(), less);
#endif
}

/// Lowers a number to another where that is smaller. Many threads may do so at a time: the smallest
/// of all is left, whoever came first.
template <typename Number>
void atomic_min(Number& least, Number value)
{
    const std::atomic_ref<Number> shared(least);
    Number seen = shared.load(std::memory_order_relaxed);
    while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

} // namespace vcarve
