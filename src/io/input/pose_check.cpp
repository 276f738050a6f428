#include "io/input/pose_check.h"

#include "model/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

namespace vcarve {

namespace {

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
