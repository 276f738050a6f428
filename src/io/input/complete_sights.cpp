#include "io/input/complete_sights.h"

#include "base/text.h"
#include "io/colmap/model_files.h"
#include "io/dense/nearest_sights.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace vcarve {

namespace {

/// A point of fewer views says nothing of where it is.
constexpr std::size_t kEnough = 2;

std::size_t count_with_few(const Tracks& tracks)
{
    std::size_t few = 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        few += tracks[i].size() < kEnough ? 1 : 0;
    }
    return few;
}

/// The views of both; of `more` only where those of `tracks` are few.
Tracks joined_where_few(const Tracks& tracks, const Tracks& more)
{
    Tracks joined;
    std::vector<std::uint32_t> row;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        row.assign(tracks[i].begin(), tracks[i].end());
        if (row.size() < kEnough) {
            row.clear();
            std::ranges::set_union(tracks[i], more[i], std::back_inserter(row));
        }
        joined.push_back(row);
    }
    return joined;
}

std::string note_on_dropped(const DroppedSights& dropped, const std::string& images)
{
    const std::size_t count = dropped.images.size();
    return fmt::format("{} sights are left out, for they are of {} image{} that {} does not have "
                       "({}{})",
                       grouped_digits(static_cast<std::int64_t>(dropped.sights)), count,
                       count == 1 ? "" : "s", images, *dropped.images.begin(),
                       count == 1 ? "" : ", ...");
}

} // namespace

std::vector<std::string> complete_sights(const FoundInput& found, const DroppedSights& dropped,
                                         Scene& scene, const Progress& progress)
{
    const FoundModel& model = found.model;
    const std::string images = model_path(model.folder, "images", model.format).string();
    std::vector<std::string> notes;
    if (dropped.sights > 0) notes.push_back(note_on_dropped(dropped, images));
    if (found.sights == SightsFrom::nearest) {
        scene.tracks = nearest_sights(scene, progress);
        notes.emplace_back("the nearest views are taken for those that saw a point, before which "
                           "no other point stands");
        return notes;
    }
    if (found.sights == SightsFrom::file) return notes;
    const auto are_most = [&](std::size_t points) { return 2 * points > scene.num_points(); };
    const std::size_t few = count_with_few(scene.tracks);
    if (!are_most(few)) return notes;
    scene.tracks =
        joined_where_few(scene.tracks, read_tracks_of_images(model.folder, model.format, scene,
                                                             progress.part(0.0, 0.3)));
    const std::size_t still_few = count_with_few(scene.tracks);
    if (still_few < few) {
        notes.push_back(fmt::format("the tracks of {} points name fewer than two views; the 2D "
                                    "points of {} tell which views saw {} of them",
                                    few, images, few - still_few));
    }
    if (!are_most(still_few)) return notes;
    scene.tracks = joined_where_few(scene.tracks, nearest_sights(scene, progress.part(0.3, 1.0)));
    notes.push_back(fmt::format("nothing tells of {} of {} points which two views saw them, so "
                                "the nearest views are taken before which no other point stands "
                                "(--sights file leaves these points out)",
                                still_few, scene.num_points()));
    return notes;
}

} // namespace vcarve
