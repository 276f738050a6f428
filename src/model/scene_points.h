#pragma once

#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace vcarve {

/// The cameras and views of a scene, in its frame, and none of its points.
inline Scene without_points(const Scene& scene)
{
    Scene result;
    result.cameras = scene.cameras;
    result.views = scene.views;
    result.offset = scene.offset;
    return result;
}

/// Adds a point of one scene to another with the same views, seen by `views`.
inline void add_point(const Scene& from, std::size_t point, std::span<const std::uint32_t> views,
                      Scene& to)
{
    to.positions.push_back(from.positions[point]);
    to.colors.push_back(from.colors[point]);
    to.errors_px.push_back(from.errors_px[point]);
    to.point_ids.push_back(from.point_ids[point]);
    if (!from.normals.empty()) to.normals.push_back(from.normals[point]);
    to.tracks.push_back(views);
}

} // namespace vcarve
