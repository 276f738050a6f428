#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "geometry/point_tree.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The points of a planar region, where they can be looked up.
struct Patch {
    const PlanarRegion* region;
    std::vector<Eigen::Vector3d> positions;
    PointTree tree; ///< refers to the positions, so a patch stays where it was made

    Patch(const PlanarRegion& of, const std::vector<Eigen::Vector3d>& all);
};

/// The planar regions of a scene, and whose its points are.
struct FlatParts {
    static constexpr std::uint32_t kNone = 0xffffffffU;

    PlanarRegions planes;
    std::vector<Patch> patches;           ///< of each region
    std::vector<std::uint32_t> region_of; ///< per point; kNone where it is of none
};

/// The tree is of the scene's points. Cost: that of planar_regions(), and 32 bytes a point.
FlatParts flat_parts(const Scene& scene, const NearestNeighbors& tree, const Progress& progress);

} // namespace vcarve
