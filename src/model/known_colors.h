#pragma once

#include "vcarve/scene.h"

#include <algorithm>

namespace vcarve {

/// Whether anything is known of the points' colours: not where all are black, as readers and
/// exporters leave them that have none.
inline bool has_colors(const Scene& scene)
{
    return std::ranges::any_of(scene.colors, [](const Color& color) { return color != Color{}; });
}

} // namespace vcarve
