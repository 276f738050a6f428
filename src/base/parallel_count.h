#pragma once

#include "base/parallel.h"

#include <atomic>
#include <cstddef>

namespace vcarve {

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

} // namespace vcarve
