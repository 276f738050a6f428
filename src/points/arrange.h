#pragma once

#include "model/scene.h"

namespace vcarve {

/// The same scene, ready for work in doubles: moved so that the median of the points is the origin
/// (the move is added to Scene::offset), points in the order of a Hilbert curve. The order depends
/// only on where the points are, not on the order they came in; points must be finite and no two at
/// one place. Cost: O(points log points).
Scene arrange_points(Scene scene);

} // namespace vcarve
