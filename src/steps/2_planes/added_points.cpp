#include "steps/2_planes/added_points.h"

#include "model/mean_color.h"
#include "model/measured_range.h"
#include "steps/1_points/spatial_sort.h"
#include "steps/2_planes/accept.h"
#include "steps/2_planes/border_candidates.h"
#include "steps/2_planes/crease_candidates.h"
#include "steps/2_planes/planar_regions.h"
#include "steps/2_planes/textureless_candidates.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

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

AddedPoints add_points(Scene& scene, const AddedPointOptions& options, const Progress& progress)
{
    AddedPoints report;
    if (!options.add_any() || has_scanners(scene)) return report;
    std::vector<AcceptedPoint> points;
    {
        const PlanarRegions planes = planar_regions(scene, progress.part(0.0, 0.4));
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
