#pragma once

#include "base/parallel.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// The cameras and views of a scene, in its frame, and none of its points.
inline Scene without_points(const Scene& scene)
{
    Scene result;
    result.cameras = scene.cameras;
    result.views = scene.views;
    result.is_dense = scene.is_dense;
    result.offset = scene.offset;
    return result;
}

/// The values at some places, in their order; none where there are no values.
template <typename Value, typename Places>
std::vector<Value> values_at(const Places& places, const std::vector<Value>& values)
{
    if (values.empty()) return {};
    std::vector<Value> result(places.size());
    parallel_for(places.size(), [&](std::size_t i) { result[i] = values[places[i]]; });
    return result;
}

/// Tracks of which row i is row_of(i), a span of views.
template <typename RowOf>
Tracks make_tracks(std::size_t count, const RowOf& row_of)
{
    Tracks tracks;
    tracks.begins.reserve(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        tracks.begins.push_back(tracks.begins.back() + row_of(i).size());
    }
    tracks.views.resize(tracks.begins.back());
    parallel_for(count, [&](std::size_t i) {
        std::ranges::copy(row_of(i),
                          tracks.views.begin() + static_cast<std::ptrdiff_t>(tracks.begins[i]));
    });
    return tracks;
}

/// Leaves only some points of a scene, in the order given, with tracks for them. The arrays are
/// replaced one after another, so that the memory of one of them, and not of a scene, is needed
/// beside those that are there. Cost: O(points), in parallel.
template <typename Points>
void keep_points(Scene& scene, const Points& points, Tracks tracks)
{
    scene.tracks = std::move(tracks);
    scene.positions = values_at(points, scene.positions);
    scene.colors = values_at(points, scene.colors);
    scene.errors_px = values_at(points, scene.errors_px);
    scene.point_ids = values_at(points, scene.point_ids);
    scene.normals = values_at(points, scene.normals);
    scene.kinds = values_at(points, scene.kinds);
}

/// Some points of a scene in the order given, with all its views; the i-th of them was seen by
/// track_of(i). Cost: O(points + sights), in parallel.
template <typename Points, typename TrackOf>
Scene select_points(const Scene& scene, const Points& points, const TrackOf& track_of)
{
    Scene result = without_points(scene);
    result.positions = values_at(points, scene.positions);
    result.colors = values_at(points, scene.colors);
    result.errors_px = values_at(points, scene.errors_px);
    result.point_ids = values_at(points, scene.point_ids);
    result.normals = values_at(points, scene.normals);
    result.kinds = values_at(points, scene.kinds);
    result.tracks = make_tracks(points.size(), track_of);
    return result;
}

} // namespace vcarve
