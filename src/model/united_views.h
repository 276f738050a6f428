#pragma once

#include "vcarve/scene.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// All views that saw one of some points, ascending, each once.
inline std::vector<std::uint32_t> united_views(const Scene& scene,
                                               std::span<const std::uint32_t> points)
{
    std::vector<std::uint32_t> views;
    for (const std::uint32_t point : points) {
        const auto track = scene.tracks[point];
        views.insert(views.end(), track.begin(), track.end());
    }
    std::ranges::sort(views);
    views.erase(std::unique(views.begin(), views.end()), views.end());
    return views;
}

} // namespace vcarve
