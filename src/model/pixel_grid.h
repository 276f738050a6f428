#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vcarve {

/// The middles of a grid of about square cells over a camera's images, in pixels: at most `most` of
/// them but at least one. None where the size of the images is not known. `most` is 1 or more.
std::vector<Eigen::Vector2d> pixel_grid(const Camera& camera, std::size_t most);

} // namespace vcarve
