#include "steps/2_planes/crease_points.h"

#include "geometry/nearest_neighbors.h"
#include "geometry/point_tree.h"
#include "model/mean_color.h"
#include "model/scene_size.h"
#include "steps/1_points/spatial_sort.h"
#include "steps/2_planes/added_place.h"
#include "steps/2_planes/blank_places.h"
#include "steps/2_planes/border_places.h"
#include "steps/2_planes/crease_places.h"
#include "steps/2_planes/flat_parts.h"
#include "steps/2_planes/sights_through.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Leaves out places where as many sights pass through the surface that there would be, if a crease
/// were there, as come from there: where none is, one looks through.
void leave_out_seen_through(const Scene& scene, const std::vector<double>& spacings,
                            std::vector<CreasePlace>& places, const Progress& progress)
{
    std::vector<std::array<Vector3d, 3>> triangles;
    for (const CreasePlace& place : places) {
        for (const Strip& strip : place.strips) {
            triangles.push_back({strip[0], strip[1], strip[2]});
            triangles.push_back({strip[2], strip[3], strip[0]});
        }
    }
    const std::vector<std::uint32_t> counts = sights_through(scene, triangles, spacings, progress);
    auto next = counts.begin();
    std::erase_if(places, [&](const CreasePlace& place) {
        const auto first = std::exchange(next, next + 2 * std::ssize(place.strips));
        return std::accumulate(first, next, std::size_t{0}) >= place.track.size();
    });
}

/// Leaves out places less than half a step from one before.
void leave_out_near_ones(std::vector<AddedPlace>& places)
{
    if (places.empty()) return;
    std::vector<Vector3d> positions(places.size());
    std::ranges::transform(places, positions.begin(), &AddedPlace::position);
    const PointTree tree(positions);
    std::vector<char> is_kept(places.size(), 1);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double near = 0.5 * places[i].step;
        tree.visit_near(positions[i], {i, places.size()}, near, [&](std::size_t other) {
            const bool is_near = (positions[other] - positions[i]).norm() < near;
            if (is_near && is_kept[other] != 0) is_kept[i] = 0;
        });
    }
    std::size_t next = 0;
    std::erase_if(places, [&](const AddedPlace&) { return is_kept[next++] == 0; });
}

void add_point(Scene& scene, const AddedPlace& place)
{
    scene.positions.push_back(place.position);
    const auto once = [](std::uint32_t) { return 1.0; };
    scene.colors.push_back(mean_color(scene, place.beside, once));
    scene.errors_px.push_back(scene.errors_px[place.beside.front()]);
    scene.point_ids.push_back(place.id);
    if (!scene.normals.empty()) scene.normals.emplace_back(Eigen::Vector3f::Zero());
    scene.tracks.push_back(place.track);
}

} // namespace

CreaseReport add_crease_points(Scene& scene, const CreaseOptions& options, const Progress& progress)
{
    if (!options.add_any() || has_dense_points(scene)) return {};
    std::vector<AddedPlace> places;
    CreaseReport report;
    {
        const NearestNeighbors tree(scene.positions);
        const FlatParts parts = flat_parts(scene, tree, progress.part(0.0, 0.5));
        report.planes = std::ssize(parts.planes.regions);
        if (options.reach > 0.0) {
            std::vector<CreasePlace> creases =
                crease_places(scene, tree, parts, options.reach, progress.part(0.5, 0.6));
            leave_out_seen_through(scene, parts.planes.spacings, creases, progress.part(0.6, 0.75));
            std::ranges::move(creases, std::back_inserter(places));
        }
        if (options.border_gap > 0.0) {
            std::vector<AddedPlace> borders =
                border_places(scene, tree, parts, options.border_gap, progress.part(0.75, 0.85));
            std::ranges::move(borders, std::back_inserter(places));
        }
        if (options.blank_step > 0.0) {
            std::vector<AddedPlace> blanks =
                blank_places(scene, tree, parts, options.blank_step, progress.part(0.85, 0.9));
            std::ranges::move(blanks, std::back_inserter(places));
        }
    }
    leave_out_near_ones(places);
    report.added = std::ssize(places);
    report.along_borders = std::ranges::count(places, kBorderPointId, &AddedPlace::id);
    report.in_blanks = std::ranges::count(places, kBlankPointId, &AddedPlace::id);
    if (places.empty()) return report;
    for (const AddedPlace& place : places) {
        add_point(scene, place);
    }
    scene = spatial_sort(std::move(scene), progress.part(0.9, 1.0));
    return report;
}

} // namespace vcarve
