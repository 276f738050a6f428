#pragma once

#include "vcarve/scene.h"

#include <cstdint>

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

} // namespace vcarve
