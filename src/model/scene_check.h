#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>

namespace vcarve {

/// The size of a scene, which determines the time and memory of a run.
struct SceneSize {
    std::uint64_t points = 0;
    std::uint64_t rays = 0;
    std::uint64_t views = 0;
    bool has_normals = false;
    bool is_dense = false; ///< a dense cloud or a scan
};

inline SceneSize size_of(const Scene& scene)
{
    return {.points = scene.num_points(),
            .rays = scene.num_rays(),
            .views = scene.views.size(),
            .has_normals = !scene.normals.empty(),
            .is_dense = scene.is_dense};
}

/// The largest valid coordinate. Areas and volumes beyond it may overflow.
inline constexpr double kFarthest = 1e100;

/// Whether no coordinate is NaN or beyond kFarthest.
inline bool is_valid_position(const Eigen::Vector3d& position)
{
    return (position.array().abs() <= kFarthest).all();
}

/// Returns a valid position unchanged, and NaN for others. The filter drops NaN later.
inline Eigen::Vector3d position_or_nan(const Eigen::Vector3d& position)
{
    if (is_valid_position(position)) return position;
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Throws UsageError if a scene is inconsistent: an array does not have one entry per point, a view
/// has no camera, or view indices of a track are not ascending. Scenes of readers are always
/// consistent; this checks scenes of library callers. Cost: O(rays), in parallel.
void require_consistent(const Scene& scene);

} // namespace vcarve
