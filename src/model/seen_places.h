#pragma once

#include "vcarve/scene.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// How much of what was looked at (region_of_interest) each view sees: in how many of the cubes
/// that fill the ball, 32 along its diameter, it saw points. Numbers of points would prefer a wall
/// seen from near, which has most of them. Of more than 100,000 points, that many, evenly chosen.
/// Cost: O(points + sights).
std::vector<std::size_t> seen_places(const Scene& scene);

} // namespace vcarve
