#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// A plane.
struct Plane {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< one of its points
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit
};

/// Points that lie on a plane.
struct PlanarRegion {
    Plane plane;                       ///< its normal looks to the views that saw the points
    double spacing = 0.0;              ///< how far its points stand apart: the median
    std::vector<std::uint32_t> points; ///< ascending
};

/// The flat parts of a scene.
struct PlanarRegions {
    std::vector<PlanarRegion> regions; ///< the flattest first
    std::vector<double> spacings;      ///< per point: how far its 12 nearest stand apart
    std::vector<char> is_one_sided; ///< per point: whether these leave 150 degrees free around it
};

/// Parts of the surface that are flat, by growing regions from the flattest points on (Poppinga,
/// Vaskevicius, Birk & Pathak 2008, by CGAL). A region takes in the neighbours of its points, of
/// the 12 nearest, that its views look at from the same side and that lie no farther from its plane
/// than a seventh of the spacing around; its plane is fitted anew whenever its points have doubled.
/// Regions of fewer than 12 points are none. The tree is of the scene's points. The result does not
/// depend on the number of threads nor on where the scene lies or how large it is, up to rounding.
/// Cost: O(points log points + sights), the search for neighbours in parallel, and 65 bytes a
/// point.
PlanarRegions planar_regions(const Scene& scene, const NearestNeighbors& tree,
                             const Progress& progress);

} // namespace vcarve
