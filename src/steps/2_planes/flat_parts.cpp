#include "steps/2_planes/flat_parts.h"

#include "model/scene_points.h"

namespace vcarve {

Patch::Patch(const PlanarRegion& of, const std::vector<Eigen::Vector3d>& all)
    : region(&of), positions(values_at(of.points, all)), tree(positions)
{
}

FlatParts flat_parts(const Scene& scene, const NearestNeighbors& tree, const Progress& progress)
{
    FlatParts parts{.planes = planar_regions(scene, tree, progress),
                    .patches = {},
                    .region_of = std::vector(scene.num_points(), FlatParts::kNone)};
    parts.patches.reserve(parts.planes.regions.size()); // each stays where it was made
    for (const PlanarRegion& region : parts.planes.regions) {
        for (const std::uint32_t point : region.points) {
            parts.region_of[point] = static_cast<std::uint32_t>(parts.patches.size());
        }
        parts.patches.emplace_back(region, scene.positions);
    }
    return parts;
}

} // namespace vcarve
