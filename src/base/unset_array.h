#pragma once

#include "base/parallel.h"

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace vcarve {

/// Allocates for UnsetArray.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
    template <typename Item>
    void construct(Item* item)
    {
        ::new (static_cast<void*>(item)) Item;
    }
    template <typename Item, typename... Arguments>
    void construct(Item* item, Arguments&&... arguments)
    {
        std::construct_at(item, std::forward<Arguments>(arguments)...);
    }
};

/// A vector whose numbers are not set before they are written, for arrays over millions of cells:
/// the parallel loop that fills one is then the first to touch its memory, and the system clears
/// its pages for all threads at once instead of for one.
template <typename T>
using UnsetArray = std::vector<T, UnsetAllocator<T>>;

/// An array of so many equal values, set by all threads.
template <typename T>
UnsetArray<T> filled_array(std::size_t count, const T& value)
{
    UnsetArray<T> array(count);
    parallel_for(
        count, [&](std::size_t i) { array[i] = value; }, 65536);
    return array;
}

} // namespace vcarve
