#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace vcarve {

/// Where rays come from that show space to be free, and which point each of them reaches. The
/// photographs and scanners of a scene are one source and virtual viewpoints another; the pixels of
/// depth maps would be one more.
struct RaySource {
    std::vector<Eigen::Vector3d> origins; ///< in the frame of the points
    const Tracks* rays = nullptr;         ///< per point, indices into `origins`; not owned
    double weight = 1.0;                  ///< of a ray, relative to a sight of the same point
    /// Whether the rays were measured: then their origins stand in free space, and the space just
    /// behind their points is likely inside. Rays that were inferred speak for outside only.
    bool is_measured = true;
};

/// The sights of a scene as a source, which refers to the scene's tracks.
inline RaySource photographs(const Scene& scene)
{
    RaySource source{.origins = std::vector<Eigen::Vector3d>(scene.views.size()),
                     .rays = &scene.tracks};
    std::ranges::transform(scene.views, source.origins.begin(), &View::center);
    return source;
}

} // namespace vcarve
