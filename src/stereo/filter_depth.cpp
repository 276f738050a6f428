#include "stereo/filter_depth.h"

#include "base/union_find.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

void drop_speckles(DepthMap& map, int min_pixels)
{
    constexpr float kSameDepth = 0.01F;
    UnionFind regions(map.planes.size());
    const auto join = [&](std::size_t a, std::size_t b) {
        const float first = map.planes[a].depth;
        const float second = map.planes[b].depth;
        const bool is_measured =
            map.costs[a] < DepthMap::kNoCost && map.costs[b] < DepthMap::kNoCost;
        if (is_measured && std::abs(first - second) < kSameDepth * first) {
            regions.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        }
    };
    for (int y = 0; y < map.height_px; ++y) {
        for (int x = 0; x < map.width_px; ++x) {
            const std::size_t pixel = map.index(x, y);
            if (map.has(x + 1, y)) join(pixel, pixel + 1);
            if (map.has(x, y + 1)) join(pixel, map.index(x, y + 1));
        }
    }
    std::vector<int> sizes(map.planes.size());
    for (std::uint32_t pixel = 0; pixel < sizes.size(); ++pixel) {
        ++sizes[regions.root(pixel)];
    }
    for (std::uint32_t pixel = 0; pixel < sizes.size(); ++pixel) {
        if (sizes[regions.root(pixel)] < min_pixels) map.costs[pixel] = DepthMap::kNoCost;
    }
}

} // namespace vcarve
