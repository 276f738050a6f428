#pragma once

#include "model/scene.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// Views nobody took, and the points they would have seen: an inference, not evidence.
struct VirtualSights {
    std::vector<Eigen::Vector3d> centers; ///< of the virtual views, in the frame of the points
    Tracks tracks;                        ///< per point, indices into `centers`
};

} // namespace vcarve
