#pragma once

#include "vcarve/scene.h"

#include <algorithm>
#include <cstdint>

namespace vcarve {

/// How much there is of a scene: what time and memory of a run depend on.
struct SceneSize {
    std::uint64_t points = 0;
    std::uint64_t sights = 0;
    std::uint64_t views = 0;
    bool has_normals = false;
    bool is_dense = false; ///< some points' reprojection errors are not known
};

/// Whether the scene holds points of a dense cloud: those whose reprojection error is not known.
inline bool has_dense_points(const Scene& scene)
{
    return std::ranges::any_of(scene.errors_px, [](double error) { return error < 0.0; });
}

inline SceneSize size_of(const Scene& scene)
{
    return {.points = scene.num_points(),
            .sights = scene.num_sights(),
            .views = scene.views.size(),
            .has_normals = !scene.normals.empty(),
            .is_dense = has_dense_points(scene)};
}

} // namespace vcarve
