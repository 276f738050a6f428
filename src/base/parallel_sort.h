#pragma once

#ifdef VCARVE_WATCHES_THREADS
#include <algorithm>
#else
#include <tbb/parallel_sort.h>
#endif

#include <functional>

namespace vcarve {

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

} // namespace vcarve
