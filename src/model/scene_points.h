#pragma once

#include "base/arrays.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// A copy of a scene without points: its cameras, views and frame.
inline Scene without_points(const Scene& scene)
{
    Scene result;
    result.cameras = scene.cameras;
    result.views = scene.views;
    result.is_dense = scene.is_dense;
    result.offset = scene.offset;
    return result;
}

/// Returns values[place] for each of `places`, in their order; nothing if `values` is empty.
template <typename Value, typename Places>
std::vector<Value> values_at(const Places& places, const std::vector<Value>& values)
{
    if (values.empty()) return {};
    std::vector<Value> result(places.size());
    parallel_for(places.size(), [&](std::size_t i) { result[i] = values[places[i]]; });
    return result;
}

/// Makes tracks whose row i is row_of(i), a span of views.
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

/// Keeps only the given points of a scene, in the given order, with the given tracks. Replaces one
/// array after another, so the additional memory is that of one array instead of a scene. Cost:
/// O(points), in parallel.
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

/// Returns a scene of the given points, in the given order, and all views. track_of(i) is the track
/// of the i-th of these points. Cost: O(points + rays), in parallel.
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

/// The union of the tracks of each group of points: row i has the views that saw a point of group
/// i, ascending. `groups[i]` lists point indices. Cost: O(rays log(rays per group)), in parallel.
template <typename Groups>
Tracks united_tracks(const Tracks& tracks, const Groups& groups)
{
    std::vector<std::uint64_t> begins{0}; // of rows that may contain views twice
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

/// Appends the points of another scene with the same views for which keeps(point) is true.
template <typename Keeps>
void append_points(const Scene& more, Scene& scene, const Keeps& keeps)
{
    const bool has_kinds = !scene.kinds.empty() || !more.kinds.empty();
    if (has_kinds) scene.kinds.resize(scene.num_points(), PointKind::measured);
    for (std::size_t point = 0; point < more.num_points(); ++point) {
        if (!keeps(point)) continue;
        scene.positions.push_back(more.positions[point]);
        if (!more.colors.empty()) scene.colors.push_back(more.colors[point]);
        scene.errors_px.push_back(more.errors_px[point]);
        scene.point_ids.push_back(more.point_ids[point]);
        if (!more.normals.empty()) scene.normals.push_back(more.normals[point]);
        if (has_kinds) scene.kinds.push_back(more.kind_of(point));
        scene.tracks.push_back(more.tracks[point]);
    }
}

/// Receives points in parts; these may lack cameras and views.
using TakePoints = std::function<void(Scene part)>;

/// One of every few points of a scene that comes in parts: the first, the (n+1)-th and so on.
class PointSample {
  public:
    /// Adds the next part. Cost: O(points of the part).
    void add(const Scene& part);

    Scene scene;                ///< half of `most` to `most` points, or all if there are fewer
    std::size_t most = 400'000; ///< points of the sample
    std::size_t one_in = 1;     ///< n, a power of two
    std::size_t points = 0;     ///< of the parts so far
    std::uint64_t rays = 0;
};

/// A scene that provides its points in parts, in their order. So they need not all be in memory at
/// the same time.
class SceneParts {
  public:
    SceneParts() = default;
    SceneParts(const SceneParts&) = delete;
    SceneParts& operator=(const SceneParts&) = delete;
    virtual ~SceneParts() = default;

    /// The total number of points.
    virtual std::size_t num_points() const = 0;
    /// Returns the next points, at most `most`, with all cameras and views; no points after the
    /// last part. May throw InputError and Cancelled.
    virtual Scene next(std::size_t most, const Progress& progress) = 0;
};

/// The parts of a scene in memory. Keeps a reference to the scene.
class PartsOfScene final : public SceneParts {
  public:
    explicit PartsOfScene(const Scene& scene) : scene_(scene) {}

    std::size_t num_points() const override { return scene_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override;

  private:
    const Scene& scene_;
    std::size_t first_ = 0; ///< first point of the next part
};

} // namespace vcarve
