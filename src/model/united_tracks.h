#pragma once

#include "base/parallel.h"
#include "base/unset_array.h"
#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Row i has all views that saw a point of group i, ascending, each once. `groups[i]` are the
/// numbers of its points. Cost: O(sights log sights a group), in parallel.
template <typename Groups>
Tracks united_tracks(const Tracks& tracks, const Groups& groups)
{
    std::vector<std::uint64_t> begins{0}; // of as many views as there are with those twice
    begins.reserve(groups.size() + 1);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        std::uint64_t views = 0;
        for (const std::uint32_t point : groups[i]) {
            views += tracks[point].size();
        }
        begins.push_back(begins.back() + views);
    }
    UnsetArray<std::uint32_t> views(begins.back());
    UnsetArray<std::uint32_t> lengths(groups.size());
    parallel_for(groups.size(), [&](std::size_t i) {
        const auto begin = views.begin() + static_cast<std::ptrdiff_t>(begins[i]);
        auto end = begin;
        for (const std::uint32_t point : groups[i]) {
            end = std::ranges::copy(tracks[point], end).out;
        }
        if (groups[i].size() > 1) {
            std::sort(begin, end);
            end = std::unique(begin, end);
        }
        lengths[i] = static_cast<std::uint32_t>(end - begin);
    });
    return make_tracks(groups.size(), [&](std::size_t i) {
        return std::span(views).subspan(begins[i], lengths[i]);
    });
}

} // namespace vcarve
