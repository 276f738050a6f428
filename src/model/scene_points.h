#pragma once

#include "base/arrays.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Row i has all views that saw a point of group i, ascending, each once. `groups[i]` are the
/// numbers of its points. Cost: O(sights log sights a group), in parallel.
template <typename Groups>
Tracks united_tracks(const Tracks& tracks, const Groups& groups)
{
    std::vector<std::uint64_t> begins{0}; // of as many views as there are with those twice
    begins.reserve(groups.size() + 1);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        std::uint64_t views = 0;
        for (const std::uint32_t point : groups[i]) {
            views += tracks[point].size();
        }
        begins.push_back(begins.back() + views);
    }
    UnsetArray<std::uint32_t> views(begins.back());
    UnsetArray<std::uint32_t> lengths(groups.size());
    parallel_for(groups.size(), [&](std::size_t i) {
        const auto begin = views.begin() + static_cast<std::ptrdiff_t>(begins[i]);
        auto end = begin;
        for (const std::uint32_t point : groups[i]) {
            end = std::ranges::copy(tracks[point], end).out;
        }
        if (groups[i].size() > 1) {
            std::sort(begin, end);
            end = std::unique(begin, end);
        }
        lengths[i] = static_cast<std::uint32_t>(end - begin);
    });
    return make_tracks(groups.size(), [&](std::size_t i) {
        return std::span(views).subspan(begins[i], lengths[i]);
    });
}

/// A scene whose points come part by part, in their order, so that not all of them need to be in
/// memory at a time.
class SceneParts {
  public:
    SceneParts() = default;
    SceneParts(const SceneParts&) = delete;
    SceneParts& operator=(const SceneParts&) = delete;
    virtual ~SceneParts() = default;

    /// How many points there are in all.
    virtual std::size_t num_points() const = 0;
    /// The next points, at most so many, with all cameras and views; none after the last. May throw
    /// InputError, and Cancelled.
    virtual Scene next(std::size_t most, const Progress& progress) = 0;
};

/// The parts of a scene that is in memory, and must stay there.
class PartsOfScene final : public SceneParts {
  public:
    explicit PartsOfScene(const Scene& scene) : scene_(scene) {}

    std::size_t num_points() const override { return scene_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override;

  private:
    const Scene& scene_;
    std::size_t first_ = 0; ///< point of the next part
};

} // namespace vcarve
