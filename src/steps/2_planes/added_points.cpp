#include "steps/2_planes/added_points.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "geometry/triangle_tree.h"
#include "model/camera.h"
#include "model/colors.h"
#include "model/views.h"
#include "steps/1_points/arrange.h"
#include "steps/2_planes/candidates.h"
#include "steps/2_planes/planar_regions.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

using Eigen::Vector3d;

namespace {

/// Minimum distance of a candidate to existing points, in steps.
double clearance(PointKind kind)
{
    return kind == PointKind::textureless ? 0.5 : 0.3;
}

/// Whether a candidate is surrounded by points of its regions, and not too close to any.
bool has_place(const Candidate& candidate, const PlanarRegions& planes)
{
    constexpr std::size_t kLook = 8;
    constexpr std::ptrdiff_t kMost = 5;
    thread_local std::vector<PointTree::Near> nearest;
    planes.tree.find_nearest(candidate.position, kLook, nearest);
    const auto is_own = [&](const PointTree::Near& near) {
        const std::uint32_t region = planes.region_of[near.point];
        return region == candidate.regions[0] || region == candidate.regions[1];
    };
    return nearest.front().distance >= clearance(candidate.kind) * candidate.step &&
           std::ranges::count_if(nearest, is_own) >= kMost;
}

/// The points beside a candidate: the two nearest of each region, or four in a textureless area.
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

/// The views of `points` that see a candidate, ascending.
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
        rays_through(scene, triangles, planes.spacings, progress);
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

std::vector<Candidate> candidates_of(const Scene& scene, const PlanarRegions& planes,
                                     const AddedPointOptions& options, const Progress& progress)
{
    std::vector<Candidate> all;
    const auto add = [&](std::vector<Candidate> more) {
        std::ranges::move(more, std::back_inserter(all));
    };
    if (options.crease_reach > 0.0)
        add(crease_candidates(scene, planes, options.crease_reach, progress.part(0.0, 0.3)));
    if (options.border_gap > 0.0 && !scene.is_dense)
        add(border_candidates(scene, planes, options.border_gap, progress.part(0.3, 0.9)));
    if (options.textureless_step > 0.0)
        add(textureless_candidates(planes, options.textureless_step, progress.part(0.9, 1.0)));
    return all;
}

void add_point(Scene& scene, const AcceptedPoint& point)
{
    scene.positions.push_back(point.candidate.position);
    const auto once = [](std::uint32_t) { return 1.0; };
    scene.colors.push_back(mean_color(scene, point.beside, once));
    scene.errors_px.push_back(scene.errors_px[point.beside.front()]);
    scene.point_ids.push_back(0);
    scene.kinds.push_back(point.candidate.kind);
    if (!scene.normals.empty()) scene.normals.emplace_back(Eigen::Vector3f::Zero());
    scene.tracks.push_back(point.track);
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
    keep_viewing_views(accepted, scene, planes, progress.part(0.4, 0.6));
    leave_out_seen_through(accepted, scene, planes, progress.part(0.6, 1.0));
    leave_out_near_ones(accepted);
    return accepted;
}

std::vector<std::uint32_t> rays_through(const Scene& scene,
                                        std::span<const std::array<Vector3d, 3>> triangles,
                                        const std::vector<double>& margins,
                                        const Progress& progress)
{
    std::vector<std::uint32_t> counts(triangles.size());
    if (triangles.empty()) return counts;
    const std::uint32_t one_in = scene.is_dense ? 3 : 1;
    const TriangleTree tree(triangles);
    const auto count = [&](std::size_t triangle) {
        std::atomic_ref(counts[triangle]).fetch_add(one_in, std::memory_order_relaxed);
    };
    parallel_for(scene.num_points(), progress, [&](std::size_t point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            if ((point + view) % one_in != 0) continue;
            visit_ray(
                scene, point, view, margins[point],
                [&](const Vector3d& from, const Vector3d& to) { tree.visit_met(from, to, count); });
        }
    });
    return counts;
}

AddedPoints add_points(Scene& scene, const AddedPointOptions& options, const Progress& progress,
                       UsualValues* usual)
{
    AddedPoints report;
    if (!options.add_any() || has_scanners(scene)) return report;
    std::vector<AcceptedPoint> points;
    {
        const PlanarRegions planes = planar_regions(scene, progress.part(0.0, 0.4), usual);
        report.regions = std::ssize(planes.regions);
        points =
            accept(scene, planes, candidates_of(scene, planes, options, progress.part(0.4, 0.7)),
                   progress.part(0.7, 0.9));
    }
    report.added = std::ssize(points);
    if (points.empty()) return report;
    scene.kinds.resize(scene.num_points(), PointKind::measured);
    for (const AcceptedPoint& point : points) {
        add_point(scene, point);
    }
    scene = spatial_sort(std::move(scene), progress.part(0.9, 1.0));
    return report;
}

} // namespace vcarve
