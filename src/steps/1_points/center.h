#pragma once

#include "vcarve/scene.h"

namespace vcarve {

/// The same scene moved so that the median of its points is the origin, for work in doubles far
/// from the world's origin; the move is added to Scene::offset. Points that are not finite stay so
/// and do not count. Two points a few roundings apart may come to lie at one place. Cost: O(points
/// + views).
Scene center_points(Scene scene);

} // namespace vcarve
