#include "io/dense/view_lists.h"

#include "base/arrays.h"
#include "model/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace vcarve {

namespace {

/// Of the sights of some thousand points.
double share_shown(const Tracks& tracks, const Scene& scene)
{
    constexpr std::size_t kPoints = 1000;
    const std::size_t step = tracks.size() / kPoints + 1;
    double sights = 0.0;
    double shown = 0.0;
    for (std::size_t point = 0; point < tracks.size(); point += step) {
        for (const std::uint32_t index : tracks[point]) {
            const View& view = scene.views[index];
            const Camera& camera = scene.cameras[view.camera];
            sights += 1.0;
            shown += view_shows(view, camera, scene.positions[point]) ? 1.0 : 0.0;
        }
    }
    return sights > 0.0 ? shown / sights : 1.0;
}

} // namespace

std::optional<Tracks> tracks_of_lists(const Tracks& lists,
                                      std::span<const std::uint32_t> file_order, const Scene& scene,
                                      std::string& note)
{
    constexpr double kMost = 0.9;
    constexpr const char* kInstead = "so the nearest views are taken instead";
    const auto last = std::ranges::max_element(lists.views);
    if (last != lists.views.end() && *last >= file_order.size()) {
        note = fmt::format("its lists view_indices name image {}, but the model has {}, counted "
                           "from 0, {}",
                           *last, file_order.size(), kInstead);
        return std::nullopt;
    }
    Tracks tracks;
    std::vector<std::uint32_t> row;
    for (std::size_t point = 0; point < lists.size(); ++point) {
        row.clear();
        for (const std::uint32_t image : lists[point]) {
            row.push_back(file_order[image]);
        }
        sort_unique(row);
        tracks.push_back(row);
    }
    const double shown = share_shown(tracks, scene);
    if (shown >= kMost) return tracks;
    note = fmt::format("{:.0f} % of the points do not show in the images that its lists "
                       "view_indices name, which seem to be those of another model, {}",
                       100.0 * (1.0 - shown), kInstead);
    return std::nullopt;
}

} // namespace vcarve
