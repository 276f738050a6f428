#include "steps/4_visibility/inferred_rays.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "io/dense/nearest_grid.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "model/views.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// The distances of the points that a view saw, by squares of its image.
class SeenPlaces {
  public:
    SeenPlaces(const Scene& scene, const View& view, double focal_px,
               std::span<const PlacesOfViews::Entry> points)
        : view_(view), camera_(scene.cameras[view.camera])
    {
        constexpr double kSquareWidth = 2.0; // over the spacing of the points in the image
        constexpr double kSteepest = 2.0;    // rise of a surface towards the view, over its width
        constexpr double kLeast = 0.01;      // least relative tolerance of distances
        squares_ = {camera_, kSquareWidth, 1.0, static_cast<double>(points.size())};
        unlike_ = 1.0 + kLeast + kSteepest * squares_.side_px() / focal_px;
        for (const auto& [point, number] : points) {
            if (const auto place = project_into(view_, camera_, scene.positions[point]))
                seen_.emplace_back(squares_.of(place->place_px), place->distance);
        }
        in_square_ = gather_rows(seen_.size(), squares_.count(), [&](std::size_t i, auto visit) {
            visit(static_cast<std::uint32_t>(seen_[i].first), static_cast<std::uint32_t>(i));
        });
    }

    /// Whether the view saw a point at a similar distance in one of the 3 x 3 squares around a
    /// position, and no clearly nearer point in the square of the position.
    bool shows(const Eigen::Vector3d& position) const
    {
        const auto place = project_into(view_, camera_, position);
        if (!place) return false;
        const std::size_t own = squares_.of(place->place_px);
        const double near = place->distance / unlike_;
        if (has_between(own, 0.0, near)) return false;
        return squares_.any_around(own, [&](std::size_t square) {
            return has_between(square, near, place->distance * unlike_);
        });
    }

  private:
    using Seen = std::pair<std::size_t, double>; ///< square and distance

    bool has_between(std::size_t square, double near, double far) const
    {
        return std::ranges::any_of(in_square_[square], [&](std::uint32_t i) {
            return near <= seen_[i].second && seen_[i].second < far;
        });
    }

    const View& view_;
    const Camera& camera_;
    ImageSquares squares_;
    double unlike_; ///< maximum ratio of distances on one surface, in adjacent squares
    std::vector<Seen> seen_;
    RowTable in_square_; ///< indices in `seen_`, per square
};

bool is_before(const Scene& scene, std::size_t view, std::size_t point)
{
    return scene.normals.empty() || scene.normals[point].isZero() ||
           scene.normals[point].cast<double>().dot(scene.views[view].center -
                                                   scene.positions[point]) > 0.0;
}

bool takes_pictures(const Scene& scene, std::uint32_t view)
{
    const Camera& camera = scene.cameras[scene.views[view].camera];
    return !camera.measures_range && camera.width_px > 0 && camera.height_px > 0;
}

/// The views that take pictures and saw points near a run of points.
std::vector<std::uint32_t> views_around(const Scene& scene, std::size_t first, std::size_t last)
{
    constexpr std::size_t kAround = 32; // on either side, in the order of the points
    constexpr std::size_t kStep = 4;
    std::vector<std::uint32_t> views;
    last = std::min(last + kAround, scene.num_points());
    for (std::size_t i = first - std::min(first, kAround); i < last; i += kStep) {
        views.insert(views.end(), scene.tracks[i].begin(), scene.tracks[i].end());
    }
    sort_unique(views);
    std::erase_if(views, [&](std::uint32_t view) { return !takes_pictures(scene, view); });
    return views;
}

/// The views in front of each point that saw points around it, but not the point. None if five or
/// more views saw the point.
std::vector<std::vector<std::uint32_t>> likely_views(const Scene& scene, const Progress& progress)
{
    constexpr std::size_t kEnough = 5;
    constexpr std::size_t kRun = 8; // points that are searched together
    std::vector<std::vector<std::uint32_t>> rows(scene.num_points());
    parallel_for((rows.size() + kRun - 1) / kRun, progress, [&](std::size_t run) {
        const std::size_t last = std::min(rows.size(), (run + 1) * kRun);
        const std::vector<std::uint32_t> around = views_around(scene, run * kRun, last);
        for (std::size_t point = run * kRun; point < last; ++point) {
            const auto track = scene.tracks[point];
            if (track.size() >= kEnough) continue;
            std::ranges::copy_if(around, std::back_inserter(rows[point]), [&](std::uint32_t view) {
                return !std::ranges::binary_search(track, view) && is_before(scene, view, point);
            });
        }
    });
    return rows;
}

} // namespace

Tracks inferred_rays(const Scene& scene, const Progress& progress)
{
    std::vector<std::vector<std::uint32_t>> rows = likely_views(scene, progress.part(0.0, 0.4));
    const auto row_of = [&](std::size_t i) { return std::span(rows[i]); };
    const Tracks likely = make_tracks(rows.size(), row_of);
    const auto places_in = [&](const Tracks& tracks) {
        return PlacesOfViews(tracks.size(), scene.views.size(),
                             [&](std::size_t i) { return tracks[i]; });
    };
    const PlacesOfViews asked = places_in(likely);
    const PlacesOfViews seen = places_in(scene.tracks);
    const std::vector<double> focals_px = mean_focals_px(scene.cameras);
    std::vector<std::uint8_t> is_kept(likely.views.size());
    const auto ask = [&](std::size_t number) {
        if (asked.of(number).empty()) return;
        const View& view = scene.views[number];
        const SeenPlaces places(scene, view, focals_px[view.camera], seen.of(number));
        for (const auto& [point, place] : asked.of(number)) {
            is_kept[likely.begins[point] + place] = places.shows(scene.positions[point]) ? 1 : 0;
        }
    };
    parallel_for(scene.views.size(), progress.part(0.4, 1.0), ask, 1);
    std::size_t next = 0;
    for (std::vector<std::uint32_t>& row : rows)
        std::erase_if(row, [&](std::uint32_t) { return is_kept[next++] == 0; });
    return make_tracks(rows.size(), row_of);
}

} // namespace vcarve
