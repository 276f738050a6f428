#pragma once

#include "model/ray_source.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// Views nobody took, and the points they would have seen: an inference, not evidence.
struct VirtualSights {
    std::vector<Eigen::Vector3d> centers; ///< of the virtual views, in the frame of the points
    Tracks tracks;                        ///< per point, indices into `centers`

    /// As a source of rays, each `weight` of a real sight, which refers to `tracks`.
    RaySource source(double weight) const
    {
        return {.origins = centers, .rays = &tracks, .weight = weight, .is_measured = false};
    }
};

} // namespace vcarve
