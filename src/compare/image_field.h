#pragma once

#include "model/scene.h"

#include <Eigen/Core>

namespace vcarve {

/// Whether a camera's image can show a point, given in the camera's frame (x right, y down, z
/// forward). Lenses are taken by their focal lengths and principal point alone: perspective models
/// project by x / z, fisheye models by the angle to the axis. Where the model distorts, the image
/// is taken a tenth larger on every side to make up for that. A model whose number is unknown, or a
/// camera without a size, shows everything before it (z > 0).
bool image_shows(const Camera& camera, const Eigen::Vector3d& x_in_cam);

/// The same for a view and a point in the frame of the view's centre.
bool view_shows(const View& view, const Camera& camera, const Eigen::Vector3d& x_in_world);

} // namespace vcarve
