#include "steps/1_points/crop.h"

#include "base/parallel.h"
#include "model/scene_points.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::AlignedBox3d;
using Flags = std::vector<std::uint8_t>; ///< 0 or 1

std::string box_text(const AlignedBox3d& box)
{
    return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g}", box.min().x(),
                       box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z());
}

[[noreturn]] void refuse_empty(const Scene& scene, const Region& region)
{
    AlignedBox3d points;
    for (const Eigen::Vector3d& position : scene.positions) {
        points.extend(position);
    }
    throw InputError(fmt::format("no point is inside the region of --crop ({}); the points span "
                                 "{}. Enlarge or move the region",
                                 box_text(region.bounds().translated(scene.offset)),
                                 box_text(points.translated(scene.offset))));
}

} // namespace

CroppedPoints crop_points(Scene scene, const Region& region, const Progress& progress)
{
    const Tracks& tracks = scene.tracks;
    Flags is_inside(scene.num_points());
    Flags says_something(scene.num_rays(), 1);
    const auto judge = [&](std::size_t point) {
        const Eigen::Vector3d& place = scene.positions[point];
        is_inside[point] = region.contains(place) ? 1 : 0;
        if (is_inside[point] != 0) return;
        for (std::size_t ray = tracks.begins[point]; ray < tracks.begins[point + 1]; ++ray) {
            const View& view = scene.views[tracks.views[ray]];
            says_something[ray] = region.meets(place, view.center) ? 1 : 0;
        }
    };
    parallel_for(scene.num_points(), progress.part(0.0, 0.9), judge);

    CroppedPoints result;
    // Reserved memory is used only once it is written
    std::vector<std::uint32_t> kept;
    kept.reserve(scene.num_points());
    Tracks kept_tracks;
    kept_tracks.begins.reserve(scene.num_points() + 1);
    kept_tracks.views.reserve(scene.num_rays());
    std::vector<std::uint32_t> views;
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        views.clear();
        for (std::size_t ray = tracks.begins[point]; ray < tracks.begins[point + 1]; ++ray) {
            if (says_something[ray] != 0) views.push_back(tracks.views[ray]);
        }
        if (is_inside[point] == 0 && views.empty()) continue;
        (is_inside[point] != 0 ? result.inside : result.witnesses) += 1;
        kept.push_back(point);
        kept_tracks.push_back(views);
    }
    if (result.inside == 0 && scene.num_points() > 0) refuse_empty(scene, region);
    keep_points(scene, kept, std::move(kept_tracks));
    result.scene = std::move(scene);
    return result;
}

} // namespace vcarve
