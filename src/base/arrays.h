#pragma once

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// The allocator of UnsetArray. It default-initializes elements, so numbers stay uninitialized.
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

/// A vector that leaves numbers uninitialized, for arrays over millions of cells. The parallel loop
/// that fills it first touches its memory, so the system clears its pages on all threads instead of
/// one.
template <typename T>
using UnsetArray = std::vector<T, UnsetAllocator<T>>;

/// An array of `count` copies of a value, filled in parallel.
template <typename T>
UnsetArray<T> filled_array(std::size_t count, const T& value)
{
    UnsetArray<T> array(count);
    parallel_for(
        count, [&](std::size_t i) { array[i] = value; }, 65536);
    return array;
}

/// Rows of numbers, stored contiguously.
struct RowTable {
    std::vector<std::uint32_t> ends; ///< the end of each row, which is the start of the next
    UnsetArray<std::uint32_t> items;

    std::span<const std::uint32_t> operator[](std::size_t row) const
    {
        const std::uint32_t begin = row == 0 ? 0 : ends[row - 1];
        return {items.data() + begin, items.data() + ends[row]};
    }
};

/// Groups the items of sources [0, count) by row, each row in the order of the sources. The
/// caller's for_each(i, visit) calls visit(row, item) for each item of source i, and runs twice.
/// This is a counting sort with one histogram per thread. The result does not depend on the thread
/// count. There must be fewer than 2^32 items. Cost: O(items + rows), and 4 bytes per row and
/// thread (at most 8 threads).
template <typename ForEach>
RowTable gather_rows(std::size_t count, std::size_t num_rows, const ForEach& for_each)
{
    constexpr std::size_t kMostBlocks = 8;
    constexpr std::size_t kLeastSources = 65536; // fewer do not justify a thread
    const std::size_t blocks = std::min({kMostBlocks, num_threads(), 1 + count / kLeastSources});
    const auto visit_block = [&](std::size_t block, const auto& visit) {
        const std::size_t end = count * (block + 1) / blocks;
        for (std::size_t i = count * block / blocks; i < end; ++i) {
            for_each(i, visit);
        }
    };
    std::vector<std::vector<std::uint32_t>> places(blocks); // counts at first
    const auto count_block = [&](std::size_t block) {
        places[block].assign(num_rows, 0);
        visit_block(block, [&](std::uint32_t row, std::uint32_t) { ++places[block][row]; });
    };
    parallel_for(blocks, count_block, 1);

    RowTable table;
    table.ends.resize(num_rows);
    std::uint32_t sum = 0;
    for (std::size_t row = 0; row < num_rows; ++row) {
        for (std::vector<std::uint32_t>& place : places) {
            const std::uint32_t counted = place[row];
            place[row] = sum;
            sum += counted;
        }
        table.ends[row] = sum;
    }
    table.items.resize(sum);
    const auto fill_block = [&](std::size_t block) {
        visit_block(block, [&](std::uint32_t row, std::uint32_t item) {
            table.items[places[block][row]++] = item;
        });
    };
    parallel_for(blocks, fill_block, 1);
    return table;
}

/// Sorts a list and removes duplicates.
template <typename Item>
void sort_unique(std::vector<Item>& items)
{
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Prefetches the memory at an address into the processor's cache. The address may be invalid.
inline void prefetch([[maybe_unused]] const void* address)
{
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

} // namespace vcarve
