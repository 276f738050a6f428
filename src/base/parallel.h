#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace vcarve {

/// Calls body(i) for every i in [0, count), from as many threads as the surrounding tbb arena has.
/// The body must not depend on the order of the calls.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1024)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              body(i);
                          }
                      });
}

/// What visit(i, items) appends to `items` for the i in [0, count), in the order of i, from as many
/// threads as the surrounding tbb arena has. A thread visits `grain` of them at a time. Needs the
/// memory of the result twice.
template <typename Item, typename Visit>
std::vector<Item> parallel_collect(std::size_t count, const Visit& visit, std::size_t grain = 16384)
{
    std::vector<std::vector<Item>> blocks((count + grain - 1) / grain);
    parallel_for(
        blocks.size(),
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

} // namespace vcarve
