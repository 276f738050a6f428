#include "steps/1_points/filter.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "base/union_find.h"
#include "model/extent.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "model/views.h"
#include "steps/1_points/wide_angle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

using Positions = std::vector<Vector3d>;
using Points = std::vector<std::uint32_t>;

/// A point, sorted by its coordinate along a direction. Surfaces are rarely perpendicular to this
/// direction, so few points have equal coordinates.
struct Along {
    double way;
    std::uint32_t point;

    bool operator<(const Along& other) const
    {
        return way != other.way ? way < other.way : point < other.point;
    }
};

double same_place_size(const Positions& positions, const Points& points)
{
    constexpr double kSame = 1e-9;
    constexpr double kMiddleHalf = 0.25; // omitted at either end
    const Positions places = values_at(points, positions);
    const auto box = middle_box(places, kMiddleHalf);
    return box.isEmpty() ? 0.0 : kSame * box.diagonal().norm();
}

/// The rounding error by which copies of a point may differ, from the largest coordinate.
double rounding_of(const Positions& positions, const Points& points)
{
    double largest = 0.0;
    for (const std::uint32_t point : points) {
        largest = std::max(largest, positions[point].cwiseAbs().maxCoeff());
    }
    return 4.0 * std::numeric_limits<double>::epsilon() * largest;
}

/// For each entry of `points`, which ascend, the index of the first entry at the same position.
Points join_within(double size, const Positions& positions, const Points& points)
{
    const Vector3d direction(0.5377, 0.3183, 0.7807);
    constexpr std::size_t kMostCompared = 64; // bounds the cost for equal coordinates
    std::vector<Along> order(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        order[i] = {direction.dot(positions[points[i]]), static_cast<std::uint32_t>(i)};
    });
    parallel_sort(order);

    UnionFind places(points.size());
    const auto position_of = [&](const Along& along) { return positions[points[along.point]]; };
    const double reach = 2.0 * direction.sum() * size; // twice, for rounding
    parallel_for(order.size(), [&](std::size_t i) {
        const std::size_t end = std::min(order.size(), i + 1 + kMostCompared);
        for (std::size_t j = i + 1; j < end && order[j].way - order[i].way <= reach; ++j) {
            const Vector3d apart = position_of(order[i]) - position_of(order[j]);
            if (apart.cwiseAbs().maxCoeff() <= size) places.join(order[i].point, order[j].point);
        }
    });
    std::vector<Along>().swap(order); // frees memory before the next allocation
    Points firsts(points.size());
    parallel_for(firsts.size(),
                 [&](std::size_t i) { firsts[i] = places.root(static_cast<std::uint32_t>(i)); });
    return firsts;
}

/// Compares a group of many points again by itself, because it may be a small part of the scene,
/// far from the rest.
void find_firsts(double size, const Positions& positions, const Points& points, Points& firsts)
{
    constexpr std::uint32_t kMostCopies = 8;
    const Points joined = join_within(size, positions, points);
    if (firsts.empty()) {
        firsts.resize(positions.size()); // only now, since join_within() uses the most memory
        std::iota(firsts.begin(), firsts.end(), 0U);
    }
    Points counts(points.size());
    for (const std::uint32_t first : joined) {
        ++counts[first];
    }
    std::map<std::uint32_t, Points> crowds;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t count = counts[joined[i]];
        if (count > kMostCopies && count < points.size()) {
            crowds[joined[i]].push_back(points[i]);
        } else {
            firsts[points[i]] = points[joined[i]];
        }
    }
    for (const auto& [first, crowd] : crowds) {
        const double own_size =
            std::max(same_place_size(positions, crowd), rounding_of(positions, crowd));
        find_firsts(std::min(own_size, size), positions, crowd, firsts);
    }
}

using PointIndices = std::vector<std::uint32_t>;

/// The points at each position, and the best of them.
struct Merged {
    std::size_t num_finite = 0;        ///< number of points with valid positions
    PointIndices best;                 ///< one point per position, ascending
    std::vector<std::uint32_t> group;  ///< per entry of `best`, its row in `members`, or kAlone
    std::vector<PointIndices> members; ///< all points of each position that has more than one

    static constexpr std::uint32_t kAlone = 0xffffffffU;
};

/// The best of the points at one position: most views, then smallest error, then smallest id.
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

/// The points with valid positions, ascending.
PointIndices finite_points(const Scene& scene)
{
    return parallel_collect<std::uint32_t>(scene.num_points(), [&](std::size_t i, auto& finite) {
        if (is_valid_position(scene.positions[i])) finite.push_back(static_cast<std::uint32_t>(i));
    });
}

Merged merge_duplicates(const Scene& scene)
{
    const PointIndices finite = finite_points(scene);
    const std::vector<std::uint32_t> firsts = first_at_place(scene.positions, finite);
    constexpr std::uint32_t kLeftOut = Merged::kAlone - 1;
    std::vector<std::uint32_t> groups(scene.num_points(), kLeftOut);     // per best point
    std::vector<std::uint32_t> rows(scene.num_points(), Merged::kAlone); // per first point
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

/// Whether two rays of a point meet at `min_angle_rad` or more.
bool sees_from_wide_enough(const Scene& scene, const Vector3d& point,
                           std::span<const std::uint32_t> track, double min_angle_rad)
{
    std::vector<Vector3d> directions;
    directions.reserve(track.size());
    for (const std::uint32_t view : track) {
        directions.push_back(scene.views[view].center - point);
    }
    return look_for_angle(directions, min_angle_rad).is_found;
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

/// Removes the positions whose points are dropped.
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

std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite)
{
    Points firsts;
    find_firsts(same_place_size(positions, finite), positions, finite, firsts);
    return firsts;
}

double median_angle_deg(const Scene& scene)
{
    return median_of_some(scene.num_points(), [&](std::size_t i) {
        const auto track = scene.tracks[i];
        const auto ray = [&](std::uint32_t view) {
            return Vector3d(scene.views[view].center - scene.positions[i]).stableNormalized();
        };
        if (track.size() < 2 || has_measured_range(scene, track)) return -1.0;
        double cosine = 1.0;
        for (const std::uint32_t view : track) {
            cosine = std::min(cosine, ray(track[0]).dot(ray(view)));
        }
        return std::acos(std::max(cosine, -1.0)) * 180.0 / std::numbers::pi;
    });
}

FilteredPoints filter_points(Scene scene, const FilterOptions& options, const Progress& progress)
{
    require_indexable(scene.num_points(), kMostIndices, "points");
    Merged merged = merge_duplicates(scene);
    progress.report(0.6);
    const Tracks united = united_tracks(scene.tracks, merged.members);
    const auto track_of = [&](std::size_t place) -> std::span<const std::uint32_t> {
        const std::uint32_t group = merged.group[place];
        return group == Merged::kAlone ? scene.tracks[merged.best[place]] : united[group];
    };

    std::vector<Verdict> verdicts(merged.best.size());
    parallel_for(verdicts.size(), [&](std::size_t place) {
        verdicts[place] = judge(scene, merged.best[place], track_of(place), options);
    });
    progress.report(0.8);

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
