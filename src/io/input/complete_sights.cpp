#include "io/input/complete_sights.h"

#include "base/text.h"
#include "io/colmap/model_files.h"
#include "io/dense/nearest_sights.h"
#include "model/camera.h"
#include "model/colors.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

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

/// The pose that was meant where the inverse was written.
View turned_round(const View& view)
{
    View turned = view;
    turned.center = -(view.cam_from_world * view.center); // what stands in the file
    turned.cam_from_world = view.cam_from_world.conjugate();
    return turned;
}

/// How many sights were looked at, and of how many the image shows the point.
struct Shown {
    double sights = 0.0;
    double as_written = 0.0;
    double turned = 0.0;
};

/// Where there are no sights, each view is asked for each point.
Shown count_shown(const Scene& scene)
{
    constexpr std::size_t kPoints = 1000;
    const std::size_t step = scene.num_points() / kPoints + 1;
    std::vector<View> turned;
    std::ranges::transform(scene.views, std::back_inserter(turned), turned_round);
    std::vector<std::uint32_t> all_views(scene.views.size());
    std::iota(all_views.begin(), all_views.end(), 0U);
    const bool has_sights = scene.num_sights() > 0;
    Shown shown;
    for (std::size_t point = 0; point < scene.num_points(); point += step) {
        const auto views =
            has_sights ? scene.tracks[point] : std::span<const std::uint32_t>(all_views);
        for (const std::uint32_t index : views) {
            const View& view = scene.views[index];
            const Camera& camera = scene.cameras[view.camera];
            if (!intrinsics(camera)) continue;
            const auto shows = [&](const View& posed) {
                return view_shows(posed, camera, scene.positions[point]) ? 1.0 : 0.0;
            };
            shown.sights += 1.0;
            shown.as_written += shows(view);
            shown.turned += shows(turned[index]);
        }
    }
    return shown;
}

} // namespace

std::vector<std::string> complete_sights(FoundInput& found, const DroppedSights& dropped,
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
    found.sights = SightsFrom::nearest;
    notes.push_back(fmt::format("nothing tells of {} of {} points which two views saw them, so "
                                "the nearest views are taken before which no other point stands "
                                "(--sights file leaves these points out)",
                                still_few, scene.num_points()));
    return notes;
}

std::vector<std::string> forget_unknown_values(Scene& scene)
{
    std::vector<std::string> notes;
    if (scene.num_points() == 0) return notes;
    if (std::ranges::all_of(scene.errors_px, [](double error) { return error == 0.0; })) {
        scene.errors_px.assign(scene.num_points(), -1.0);
        notes.emplace_back("the error of every point is 0, so errors are taken for unknown: no "
                           "point falls to --max-error, and all weigh the same");
    }
    if (!has_colors(scene)) {
        notes.emplace_back("the points have no colours, so the surface gets none; normals show "
                           "its shape");
    }
    return notes;
}

std::string warning_of_poses(const Scene& scene, const std::filesystem::path& images)
{
    constexpr double kFew = 0.75;
    constexpr double kMost = 0.9;
    constexpr double kMany = 0.3; // of all points, an image in the right place
    const bool has_sights = scene.num_sights() > 0;
    const Shown shown = count_shown(scene);
    const bool is_amiss =
        has_sights ? shown.as_written < kFew * shown.sights : 2.0 * shown.as_written < shown.turned;
    if (!is_amiss) return "";
    const std::string finding =
        has_sights ? fmt::format("{:.0f} % of the sights are of points that do not show in the "
                                 "image that saw them",
                                 100.0 * (1.0 - shown.as_written / shown.sights))
                   : "few points show in the images";
    if (shown.turned >= (has_sights ? kMost : kMany) * shown.sights) {
        return fmt::format("{}, but do with the inverse poses: {} seems to hold camera-to-world "
                           "where COLMAP wants world-to-camera, so the surface will be wrong",
                           finding, images.string());
    }
    if (!has_sights) return "";
    return fmt::format("{}: the poses of {} and the points do not seem to belong together, so the "
                       "surface will be wrong",
                       finding, images.string());
}

std::string warning_of_frames(const Scene& scene, const std::filesystem::path& cloud,
                              const std::filesystem::path& images)
{
    constexpr std::size_t kPoints = 1000;
    constexpr double kMost = 0.5;
    const std::size_t step = scene.num_points() / kPoints + 1;
    double points = 0.0;
    double shown = 0.0;
    for (std::size_t point = 0; point < scene.num_points(); point += step) {
        const auto shows = [&](const View& view) {
            return view_shows(view, scene.cameras[view.camera], scene.positions[point]);
        };
        points += 1.0;
        shown += std::ranges::any_of(scene.views, shows) ? 1.0 : 0.0;
    }
    if (shown >= kMost * points) return "";
    return fmt::format("{:.0f} % of the points of {} show in no image of {}: they seem to stand in "
                       "another frame than the poses, so the surface will be wrong",
                       100.0 * (1.0 - shown / points), cloud.string(), images.string());
}

} // namespace vcarve
