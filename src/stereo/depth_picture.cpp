#include "stereo/depth_picture.h"

#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

} // namespace

std::int64_t num_measured(const DepthMap& map)
{
    return std::ranges::count_if(map.costs, [](float cost) { return cost < DepthMap::kNoCost; });
}

std::size_t fullest(const std::vector<DepthMap>& maps)
{
    const auto most = std::ranges::max_element(maps, {}, num_measured);
    return most == maps.end() ? 0 : static_cast<std::size_t>(most - maps.begin());
}

DepthPicture depth_picture(const StereoView& view, const DepthMap& map)
{
    constexpr Rgb kUnmeasured = {40, 50, 110};
    constexpr float kDarkest = 30.0F;
    std::vector<float> nearness; // 1 / depth, ascending
    for (std::size_t i = 0; i < map.costs.size(); ++i) {
        if (map.is_measured(i)) nearness.push_back(1.0F / map.planes[i].depth);
    }
    std::ranges::sort(nearness);
    const std::size_t tail = nearness.size() / 50;
    const float farthest = nearness.empty() ? 0.0F : nearness[tail];
    const float nearest = nearness.empty() ? 1.0F : nearness[nearness.size() - 1 - tail];
    const float range = std::max(nearest - farthest, 1e-6F * nearest);

    const Photograph empty = {map.width_px, map.height_px, {}};
    DepthPicture picture = {view.view, empty, empty};
    for (std::size_t i = 0; i < map.costs.size(); ++i) {
        const Color& color = view.colors[i];
        picture.photograph.rgb.insert(picture.photograph.rgb.end(), {color[0], color[1], color[2]});
        Rgb shown = kUnmeasured;
        if (map.is_measured(i)) {
            const float share =
                std::clamp((1.0F / map.planes[i].depth - farthest) / range, 0.0F, 1.0F);
            shown.fill(static_cast<std::uint8_t>(kDarkest + (255.0F - kDarkest) * share));
        }
        picture.depth.rgb.insert(picture.depth.rgb.end(), shown.begin(), shown.end());
    }
    return picture;
}

} // namespace vcarve
