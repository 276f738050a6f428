#include "steps/1_points/filter.h"

#include "base/index_limit.h"
#include "base/parallel.h"
#include "base/unlimited.h"
#include "model/measured_range.h"
#include "model/place.h"
#include "model/scene_points.h"
#include "model/united_tracks.h"
#include "steps/1_points/same_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using PointIndices = std::vector<std::uint32_t>;

/// Points at one place, by the index of the best of them.
struct Merged {
    std::size_t num_finite = 0;        ///< of all points, those that are at a place
    PointIndices best;                 ///< one point a place, ascending
    std::vector<std::uint32_t> group;  ///< per entry of `best`, its row in `members`, or kAlone
    std::vector<PointIndices> members; ///< all points of a place that has more than one

    static constexpr std::uint32_t kAlone = 0xffffffffU;
};

/// Which of the points at one place stands for them: most views, smallest error, smallest id.
std::uint32_t best_of(const Scene& scene, const PointIndices& points)
{
    const auto worth = [&](std::uint32_t i) {
        const double error = scene.errors_px[i];
        return std::tuple(-static_cast<std::int64_t>(scene.tracks[i].size()),
                          error < 0.0 ? kUnlimited : error, scene.point_ids[i]);
    };
    return *std::min_element(points.begin(), points.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return worth(a) < worth(b); });
}

/// The points that lie at a place, ascending.
PointIndices finite_points(const Scene& scene)
{
    return parallel_collect<std::uint32_t>(scene.num_points(), [&](std::size_t i, auto& finite) {
        if (is_place(scene.positions[i])) finite.push_back(static_cast<std::uint32_t>(i));
    });
}

Merged merge_duplicates(const Scene& scene)
{
    const PointIndices finite = finite_points(scene);
    const std::vector<std::uint32_t> firsts = first_at_place(scene.positions, finite);
    constexpr std::uint32_t kLeftOut = Merged::kAlone - 1;
    std::vector<std::uint32_t> groups(scene.num_points(), kLeftOut);     // of the best of a place
    std::vector<std::uint32_t> rows(scene.num_points(), Merged::kAlone); // of the first
    Merged merged;
    merged.num_finite = finite.size();
    for (const std::uint32_t point : finite) {
        const std::uint32_t first = firsts[point];
        if (first == point) {
            groups[point] = Merged::kAlone;
            continue;
        }
        if (rows[first] == Merged::kAlone) {
            rows[first] = static_cast<std::uint32_t>(merged.members.size());
            merged.members.push_back({first});
        }
        merged.members[rows[first]].push_back(point);
    }
    for (std::uint32_t row = 0; row < merged.members.size(); ++row) {
        const PointIndices& members = merged.members[row];
        groups[members.front()] = kLeftOut;
        groups[best_of(scene, members)] = row;
    }
    merged.best.reserve(finite.size());
    merged.group.reserve(finite.size());
    for (std::uint32_t point = 0; point < groups.size(); ++point) {
        if (groups[point] != kLeftOut) {
            merged.best.push_back(point);
            merged.group.push_back(groups[point]);
        }
    }
    return merged;
}

/// Whether two of the sights of a point meet at `min_angle_rad` or more.
bool sees_from_wide_enough(const Scene& scene, const Vector3d& point,
                           std::span<const std::uint32_t> track, double min_angle_rad)
{
    std::vector<Vector3d> directions;
    directions.reserve(track.size());
    for (const std::uint32_t view : track) {
        directions.push_back(scene.views[view].center - point);
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double sine = directions[i].cross(directions[j]).norm();
            const double cosine = directions[i].dot(directions[j]);
            if (std::atan2(sine, cosine) >= min_angle_rad) {
                return true;
            }
        }
    }
    return false;
}

enum class Verdict : std::uint8_t { keep, few_views, high_error, low_angle };

Verdict judge(const Scene& scene, std::uint32_t point, std::span<const std::uint32_t> track,
              const FilterOptions& options)
{
    const bool has_range = has_measured_range(scene, track);
    if (!has_range && track.size() < static_cast<std::size_t>(options.min_views)) {
        return Verdict::few_views;
    }
    if (options.max_error_px > 0.0 && scene.errors_px[point] > options.max_error_px) {
        return Verdict::high_error;
    }
    const double min_angle_rad = options.min_angle_deg * std::numbers::pi / 180.0;
    const bool is_triangulated = track.size() > 1 && !has_range;
    if (min_angle_rad > 0.0 && is_triangulated &&
        !sees_from_wide_enough(scene, scene.positions[point], track, min_angle_rad)) {
        return Verdict::low_angle;
    }
    return Verdict::keep;
}

void count(Verdict verdict, FilterReport& report)
{
    report.few_views += verdict == Verdict::few_views ? 1 : 0;
    report.high_error += verdict == Verdict::high_error ? 1 : 0;
    report.low_angle += verdict == Verdict::low_angle ? 1 : 0;
}

/// Leaves the places whose points are to be kept.
void drop_places(Merged& merged, const std::vector<Verdict>& verdicts)
{
    std::size_t kept = 0;
    for (std::size_t place = 0; place < verdicts.size(); ++place) {
        if (verdicts[place] != Verdict::keep) continue;
        merged.best[kept] = merged.best[place];
        merged.group[kept] = merged.group[place];
        ++kept;
    }
    merged.best.resize(kept);
    merged.group.resize(kept);
}

} // namespace

FilteredPoints filter_points(Scene scene, const FilterOptions& options, const Progress& progress)
{
    require_indexable(scene.num_points(), kMostIndices, "points");
    Merged merged = merge_duplicates(scene);
    progress.tell(0.6);
    const Tracks united = united_tracks(scene.tracks, merged.members);
    const auto track_of = [&](std::size_t place) -> std::span<const std::uint32_t> {
        const std::uint32_t group = merged.group[place];
        return group == Merged::kAlone ? scene.tracks[merged.best[place]] : united[group];
    };

    std::vector<Verdict> verdicts(merged.best.size());
    parallel_for(verdicts.size(), [&](std::size_t place) {
        verdicts[place] = judge(scene, merged.best[place], track_of(place), options);
    });
    progress.tell(0.8);

    FilteredPoints result;
    result.report.non_finite = static_cast<std::int64_t>(scene.num_points() - merged.num_finite);
    result.report.duplicate = static_cast<std::int64_t>(merged.num_finite - merged.best.size());
    for (const Verdict verdict : verdicts) {
        count(verdict, result.report);
    }
    drop_places(merged, verdicts);
    keep_points(scene, merged.best, make_tracks(merged.best.size(), track_of));
    result.scene = std::move(scene);
    return result;
}

} // namespace vcarve
