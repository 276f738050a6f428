#pragma once

#ifdef VCARVE_WATCHES_THREADS
#include "base/watched_loops.h"
#else
#include <tbb/parallel_invoke.h>
#endif

namespace vcarve {

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

} // namespace vcarve
