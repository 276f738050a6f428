#include "model/scene_check.h"

#include "base/parallel.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace vcarve {

namespace {

void require_one_a_point(const Scene& scene, std::string_view name, std::size_t entries)
{
    if (entries == scene.num_points()) return;
    throw UsageError(fmt::format("the scene's {} have {} entries, expected {} (one per point)",
                                 name, entries, scene.num_points()));
}

void require_cameras(const Scene& scene)
{
    for (const View& view : scene.views) {
        if (view.camera >= scene.cameras.size()) {
            throw UsageError(fmt::format("view {} of the scene has camera index {}, expected an "
                                         "index below {}, the number of cameras",
                                         view.id, view.camera, scene.cameras.size()));
        }
    }
}

/// Whether `begins` divides `views` into rows.
bool has_rows(const Tracks& tracks)
{
    return tracks.begins.front() == 0 && tracks.begins.back() == tracks.views.size() &&
           std::ranges::is_sorted(tracks.begins);
}

bool is_track(std::span<const std::uint32_t> row, std::size_t num_views)
{
    return std::ranges::adjacent_find(row, std::ranges::greater_equal()) == row.end() &&
           (row.empty() || row.back() < num_views);
}

void require_tracks(const Scene& scene)
{
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::size_t first_wrong = kNone;
    parallel_for(scene.num_points(), [&](std::size_t point) {
        if (!is_track(scene.tracks[point], scene.views.size())) atomic_min(first_wrong, point);
    });
    if (first_wrong == kNone) return;
    throw UsageError(fmt::format("the track of point {} of the scene is invalid, expected "
                                 "strictly ascending view indices below {}",
                                 first_wrong, scene.views.size()));
}

} // namespace

void require_consistent(const Scene& scene)
{
    require_one_a_point(scene, "colors", scene.colors.size());
    require_one_a_point(scene, "errors_px", scene.errors_px.size());
    require_one_a_point(scene, "point_ids", scene.point_ids.size());
    if (!scene.normals.empty()) require_one_a_point(scene, "normals", scene.normals.size());
    if (!scene.kinds.empty()) require_one_a_point(scene, "kinds", scene.kinds.size());
    if (scene.tracks.begins.empty() || !has_rows(scene.tracks)) {
        throw UsageError(
            "the scene's tracks.begins is invalid, expected ascending offsets from 0 to "
            "the size of tracks.views");
    }
    require_one_a_point(scene, "tracks", scene.tracks.size());
    require_cameras(scene);
    require_tracks(scene);
}

} // namespace vcarve
