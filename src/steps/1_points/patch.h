#pragma once

#include "geometry/point_tree.h"
#include "model/scene_points.h"
#include "steps/1_points/planar_regions.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// The points of a planar region, where they can be looked up.
struct Patch {
    const PlanarRegion* region;
    std::vector<Eigen::Vector3d> positions;
    PointTree tree; ///< refers to the positions, so a patch stays where it was made

    Patch(const PlanarRegion& of, const std::vector<Eigen::Vector3d>& all)
        : region(&of), positions(values_at(of.points, all)), tree(positions)
    {
    }
};

} // namespace vcarve
