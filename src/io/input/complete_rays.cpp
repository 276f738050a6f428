#include "io/input/complete_rays.h"

#include "base/text.h"
#include "io/colmap/model_files.h"
#include "io/dense/nearest_rays.h"
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

/// With fewer views, the position of a point is not determined.
constexpr std::size_t kEnough = 2;

std::size_t count_with_few(const Tracks& tracks)
{
    std::size_t few = 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        few += tracks[i].size() < kEnough ? 1 : 0;
    }
    return few;
}

/// Adds the views in `more` to points that have few views in `tracks`.
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

std::string note_on_dropped(const DroppedRays& dropped, const std::string& images)
{
    const std::size_t count = dropped.images.size();
    return fmt::format("dropped {} to {} missing in {} ({}{})",
                       counted(static_cast<std::int64_t>(dropped.rays), "rays"),
                       counted(size_of(count), "images"), images, *dropped.images.begin(),
                       count == 1 ? "" : ", ...");
}

/// The inverse pose, which is correct if the file has camera-to-world poses.
View turned_round(const View& view)
{
    View turned = view;
    turned.center = -(view.cam_from_world * view.center); // the translation in the file
    turned.cam_from_world = view.cam_from_world.conjugate();
    return turned;
}

/// The number of tested rays, and of rays whose point projects into the image.
struct Shown {
    double rays = 0.0;
    double as_written = 0.0;
    double turned = 0.0;
};

/// Tests the rays of about 1000 points, or if there are no rays, all views of these points.
Shown count_shown(const Scene& scene)
{
    constexpr std::size_t kPoints = 1000;
    const std::size_t step = scene.num_points() / kPoints + 1;
    std::vector<View> turned;
    std::ranges::transform(scene.views, std::back_inserter(turned), turned_round);
    std::vector<std::uint32_t> all_views(scene.views.size());
    std::iota(all_views.begin(), all_views.end(), 0U);
    const bool has_rays = scene.num_rays() > 0;
    Shown shown;
    for (std::size_t point = 0; point < scene.num_points(); point += step) {
        const auto views =
            has_rays ? scene.tracks[point] : std::span<const std::uint32_t>(all_views);
        for (const std::uint32_t index : views) {
            const View& view = scene.views[index];
            const Camera& camera = scene.cameras[view.camera];
            if (!intrinsics(camera)) continue;
            const auto shows = [&](const View& posed) {
                return view_shows(posed, camera, scene.positions[point]) ? 1.0 : 0.0;
            };
            shown.rays += 1.0;
            shown.as_written += shows(view);
            shown.turned += shows(turned[index]);
        }
    }
    return shown;
}

} // namespace

bool lacks_rays(const FoundInput& found, const Scene& scene)
{
    if (found.rays != RaysFrom::automatic) return found.rays == RaysFrom::nearest;
    return 2 * count_with_few(scene.tracks) > scene.num_points();
}

std::vector<std::string> complete_rays(FoundInput& found, const DroppedRays& dropped, Scene& scene,
                                       const Progress& progress)
{
    const FoundModel& model = found.model;
    const std::string images = model_path(model.folder, "images", model.format).string();
    std::vector<std::string> notes;
    if (dropped.rays > 0) notes.push_back(note_on_dropped(dropped, images));
    if (found.rays == RaysFrom::nearest) {
        scene.tracks = nearest_rays(scene, progress);
        notes.emplace_back("points get rays to the nearest views with an unobstructed line to "
                           "them");
        return notes;
    }
    if (!lacks_rays(found, scene)) return notes;
    const std::size_t few = count_with_few(scene.tracks);
    scene.tracks =
        joined_where_few(scene.tracks, read_tracks_of_images(model.folder, model.format, scene,
                                                             progress.part(0.0, 0.3)));
    const std::size_t still_few = count_with_few(scene.tracks);
    if (still_few < few) {
        notes.push_back(fmt::format("{} have fewer than two views in their tracks; the 2D points "
                                    "of {} supply views of {} of them",
                                    counted(size_of(few), "points"), images,
                                    grouped_digits(size_of(few - still_few))));
    }
    if (!lacks_rays(found, scene)) return notes;
    scene.tracks = joined_where_few(scene.tracks, nearest_rays(scene, progress.part(0.3, 1.0)));
    found.rays = RaysFrom::nearest;
    notes.push_back(fmt::format("{} of {} have fewer than two views, so they get the "
                                "nearest views with an unobstructed line to them (--rays file "
                                "drops these points)",
                                grouped_digits(size_of(still_few)),
                                counted(size_of(scene.num_points()), "points")));
    return notes;
}

std::vector<std::string> forget_unknown_values(Scene& scene)
{
    std::vector<std::string> notes;
    if (scene.num_points() == 0) return notes;
    if (std::ranges::all_of(scene.errors_px, [](double error) { return error == 0.0; })) {
        scene.errors_px.assign(scene.num_points(), -1.0);
        notes.emplace_back("the error of every point is 0, so errors are unknown: --max-error "
                           "drops no point, and errors do not change weights");
    }
    if (!has_colors(scene)) {
        notes.emplace_back("the points have no colors, so the mesh has normals, but no colors");
    }
    return notes;
}

std::string warning_of_poses(const Scene& scene, const std::filesystem::path& images)
{
    constexpr double kFew = 0.75;
    constexpr double kMost = 0.9;
    constexpr double kMany = 0.3; // fraction of all points in the image of a correct pose
    const bool has_rays = scene.num_rays() > 0;
    const Shown shown = count_shown(scene);
    const bool is_amiss =
        has_rays ? shown.as_written < kFew * shown.rays : 2.0 * shown.as_written < shown.turned;
    if (!is_amiss) return "";
    const std::string finding =
        has_rays ? fmt::format("{:.0f} % of the rays have a point that does not project into "
                               "the image",
                               100.0 * (1.0 - shown.as_written / shown.rays))
                 : "few points project into the images";
    if (shown.turned >= (has_rays ? kMost : kMany) * shown.rays) {
        return fmt::format("{}, unless poses are inverted: {} seems to contain camera-to-world "
                           "poses, but COLMAP uses world-to-camera, so the mesh will be wrong",
                           finding, images.string());
    }
    if (!has_rays) return "";
    return fmt::format("{}: the poses of {} and the points do not seem to match, so the mesh will "
                       "be wrong",
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
    return fmt::format("{:.0f} % of the points of {} project into no image of {}: points and poses "
                       "seem to have different frames, so the mesh will be wrong",
                       100.0 * (1.0 - shown / points), cloud.string(), images.string());
}

} // namespace vcarve
