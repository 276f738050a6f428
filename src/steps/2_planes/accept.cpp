#include "steps/2_planes/accept.h"

#include "base/parallel.h"
#include "base/sort_unique.h"
#include "model/camera.h"
#include "steps/2_planes/sights_through.h"
#include "steps/2_planes/views_looking.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// How near to it a candidate bears no point, in steps.
double clearance(PointKind kind)
{
    return kind == PointKind::textureless ? 0.5 : 0.3;
}

/// Whether a candidate stands amid its own regions' points, and at none of them.
bool has_place(const Candidate& candidate, const PlanarRegions& planes)
{
    constexpr std::size_t kLook = 8;
    constexpr std::ptrdiff_t kMost = 5;
    thread_local std::vector<NearestNeighbors::Neighbor> nearest;
    planes.tree.find(candidate.position, kLook, nearest);
    const auto is_own = [&](const NearestNeighbors::Neighbor& near) {
        const std::uint32_t region = planes.region_of[near.point];
        return region == candidate.regions[0] || region == candidate.regions[1];
    };
    const double clear = clearance(candidate.kind) * candidate.step;
    return nearest.front().distance_sq >= clear * clear &&
           std::ranges::count_if(nearest, is_own) >= kMost;
}

/// The points beside a candidate: of each of its regions the nearest two, of a single one four.
std::vector<std::uint32_t> points_beside(const Candidate& candidate, const PlanarRegions& planes)
{
    const auto [a, b] = candidate.regions;
    const std::size_t count = candidate.kind == PointKind::textureless ? 4 : 2;
    std::vector<std::uint32_t> beside = planes.regions[a].nearest(candidate.position, count);
    if (b != a) {
        std::ranges::copy(planes.regions[b].nearest(candidate.position, count),
                          std::back_inserter(beside));
    }
    return beside;
}

/// The views of some points that see a candidate, ascending.
std::vector<std::uint32_t> views_seeing(const Candidate& candidate, const PlanarRegions& planes,
                                        const Scene& scene, std::span<const std::uint32_t> points)
{
    std::vector<std::uint32_t> views;
    for (const std::uint32_t point : points) {
        std::ranges::copy(scene.tracks[point], std::back_inserter(views));
    }
    sort_unique(views);
    std::erase_if(views, [&](std::uint32_t index) {
        const View& view = scene.views[index];
        const auto is_before = [&](std::uint32_t region) {
            return planes.regions[region].plane.normal.dot(view.center - candidate.position) > 0.0;
        };
        return !(candidate.stands_out ? std::ranges::any_of(candidate.regions, is_before)
                                      : std::ranges::all_of(candidate.regions, is_before)) ||
               !view_shows(view, scene.cameras[view.camera], candidate.position);
    });
    return views;
}

void leave_out_seen_through(std::vector<AcceptedPoint>& points, const Scene& scene,
                            const PlanarRegions& planes, const Progress& progress)
{
    std::vector<std::array<Vector3d, 3>> triangles;
    for (const AcceptedPoint& point : points) {
        std::ranges::copy(point.candidate.surface, std::back_inserter(triangles));
    }
    const std::vector<std::uint32_t> counts =
        sights_through(scene, triangles, planes.spacings, progress);
    auto next = counts.begin();
    std::erase_if(points, [&](const AcceptedPoint& point) {
        const auto first = std::exchange(next, next + std::ssize(point.candidate.surface));
        return std::accumulate(first, next, std::size_t{0}) >= point.track.size();
    });
}

void leave_out_near_ones(std::vector<AcceptedPoint>& points)
{
    if (points.empty()) return;
    std::vector<Vector3d> positions(points.size());
    std::ranges::transform(points, positions.begin(),
                           [](const AcceptedPoint& point) { return point.candidate.position; });
    const PointTree tree(positions);
    std::vector<char> is_kept(points.size(), 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double near = 0.5 * points[i].candidate.step;
        tree.visit_near(positions[i], {i, points.size()}, near, [&](std::size_t other) {
            const bool is_near = (positions[other] - positions[i]).norm() < near;
            if (is_near && is_kept[other] != 0) is_kept[i] = 0;
        });
    }
    std::size_t next = 0;
    std::erase_if(points, [&](const AcceptedPoint&) { return is_kept[next++] == 0; });
}

} // namespace

std::vector<AcceptedPoint> accept(const Scene& scene, const PlanarRegions& planes,
                                  std::vector<Candidate> candidates, const Progress& progress)
{
    const auto look = [&](std::size_t i, std::vector<AcceptedPoint>& seen) {
        if (!has_place(candidates[i], planes)) return;
        std::vector<std::uint32_t> beside = points_beside(candidates[i], planes);
        std::vector<std::uint32_t> track = views_seeing(candidates[i], planes, scene, beside);
        if (track.size() >= 2)
            seen.push_back({std::move(candidates[i]), std::move(beside), std::move(track)});
    };
    std::vector<AcceptedPoint> accepted =
        parallel_collect<AcceptedPoint>(candidates.size(), progress.part(0.0, 0.4), look, 256);
    keep_views_that_look(accepted, scene, planes, progress.part(0.4, 0.6));
    leave_out_seen_through(accepted, scene, planes, progress.part(0.6, 1.0));
    leave_out_near_ones(accepted);
    return accepted;
}

} // namespace vcarve
