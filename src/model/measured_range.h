#pragma once

#include "vcarve/scene.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace vcarve {

/// Whether one of some views is a scanner: then the range of a point that they saw was measured,
/// and is as well known as if other views had seen the point, too.
inline bool has_measured_range(const Scene& scene, std::span<const std::uint32_t> track)
{
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return scene.cameras[scene.views[view].camera].measures_range;
    });
}

/// Whether a scene has a scanner among its views.
inline bool has_scanners(const Scene& scene)
{
    return std::ranges::any_of(
        scene.views, [&](const View& view) { return scene.cameras[view.camera].measures_range; });
}

} // namespace vcarve
