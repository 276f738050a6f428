#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>

namespace vcarve {

/// How much there is of a scene: what time and memory of a run depend on.
struct SceneSize {
    std::uint64_t points = 0;
    std::uint64_t sights = 0;
    std::uint64_t views = 0;
    bool has_normals = false;
    bool is_dense = false; ///< a dense cloud or a scan
};

inline SceneSize size_of(const Scene& scene)
{
    return {.points = scene.num_points(),
            .sights = scene.num_sights(),
            .views = scene.views.size(),
            .has_normals = !scene.normals.empty(),
            .is_dense = scene.is_dense};
}

/// No coordinate is larger: of places further out neither an area nor a volume is a finite number.
inline constexpr double kFarthest = 1e100;

/// Whether a position is a place, and neither too far out nor not a number.
inline bool is_place(const Eigen::Vector3d& position)
{
    return (position.array().abs() <= kFarthest).all();
}

/// The position where it is a place, else one that is not a number, as which it is dropped later.
inline Eigen::Vector3d place_or_none(const Eigen::Vector3d& position)
{
    if (is_place(position)) return position;
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Throws UsageError where the arrays of a scene do not fit each other: where one has not an entry
/// a point, a view has no camera, or a track is not a row of ascending numbers of views. What
/// readers make always fits; this is for scenes that somebody filled. Cost: O(sights), in parallel.
void require_consistent(const Scene& scene);

} // namespace vcarve
