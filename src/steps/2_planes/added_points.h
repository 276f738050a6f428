#pragma once

#include "base/progress.h"
#include "steps/2_planes/candidates.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// A point to add to a scene.
struct AcceptedPoint {
    Candidate candidate;
    std::vector<std::uint32_t> beside = {}; ///< the nearest points of its regions
    std::vector<std::uint32_t> track = {};  ///< at least two views that see it, ascending
};

/// Returns the candidates that points and rays confirm, in their order. All kinds of candidates
/// must pass the same tests:
///
/// 1. No point of the scene is within .3 steps of it (.5 steps if textureless).
/// 2. At least five of the eight nearest points belong to its regions. So no other object is there,
///    and a curved surface is not extended.
/// 3. At least two views see it. Views of the nearest points of its regions are tested. They must
///    show the position and be in front of the planes of all its regions, or of one plane at
///    a convex crease. In textureless areas they must look at it, too (keep_viewing_views).
/// 4. Fewer rays pass through its surface than see it; more would show an opening. The part of a
///    ray within one spacing of its point does not count.
/// 5. No earlier accepted candidate is within half a step.
///
/// Cost: O(log points) per candidate and O(log candidates) per ray, in parallel.
std::vector<AcceptedPoint> accept(const Scene& scene, const PlanarRegions& planes,
                                  std::vector<Candidate> candidates, const Progress& progress);

/// Removes from the tracks of textureless points the views that do not look at them, as far as the
/// model shows. Only the plane defines the position of such a point, so an object may occlude it. A
/// view looks at a position under two conditions. The nearest of its points in its image belongs to
/// the region. No other planar region covers the position, as a roof covers the ground. A region
/// covers it if the view is in front of its plane, and the normal at the position meets the hull
/// from behind. Points with fewer than two remaining views are dropped. Cost: O(rays log rays +
/// points x views log points), in parallel, and 100 bytes per ray of a view and thread.
void keep_viewing_views(std::vector<AcceptedPoint>& points, const Scene& scene,
                        const PlanarRegions& planes, const Progress& progress);

/// Calls visit(from, to) with the ray from a point to a view. The segment starts `margin` (a
/// length) away from the point, at most half of the ray. Points are slightly in front of or behind
/// the surface.
template <typename Visit>
void visit_ray(const Scene& scene, std::size_t point, std::uint32_t view, double margin,
               const Visit& visit)
{
    constexpr double kMostOfRay = 0.5;
    const Eigen::Vector3d& center = scene.views[view].center;
    const Eigen::Vector3d way = center - scene.positions[point];
    const double length = way.norm();
    if (length == 0.0) return;
    const double left_out = std::min(margin / length, kMostOfRay);
    visit(scene.positions[point] + left_out * way, center);
}

/// Returns the number of rays that pass through each triangle, without the margins at their points
/// (visit_ray()). In a dense cloud one ray in three is traced, and counts as three. It builds a
/// tree of the few triangles; RayTree is a tree of all rays, for many queries. Cost: O(triangles
/// log triangles + rays log triangles), in parallel, and about 200 bytes per triangle.
std::vector<std::uint32_t> rays_through(const Scene& scene,
                                        std::span<const std::array<Eigen::Vector3d, 3>> triangles,
                                        const std::vector<double>& margins,
                                        const Progress& progress);

/// The number of planar regions and added points.
struct AddedPoints {
    std::int64_t regions = 0; ///< planar regions of the surface
    std::int64_t added = 0;   ///< points
};

/// Adds points to the planar regions of the surface (planar_regions) where feature detectors find
/// few. There cells cut off or bridge corners, and no labeling can restore these.
/// Candidates are along creases (crease_candidates), along borders
/// (border_candidates) and in textureless areas (textureless_candidates), and accept() tests them.
/// Lafarge & Alliez (2013) structure point sets in this way, without views; here each point has
/// rays, which carve like others. Space behind a border is unknown, so rays of border points do not
/// vote for inside (RayCaster).
///
/// An added point has the mean color of the points beside it and the error of the nearest one.
/// Dense clouds get no border points, because their points are dense enough. Scans get no points,
/// because the scanner measured all surfaces. The points must be in the order of spatial_sort(),
/// and still are afterwards. The result does not depend on the thread count nor, up to rounding, on
/// the position and scale of the scene. Cost: that of these steps and a sort; 90 bytes per point,
/// and the memory of crossings (border_candidates).
AddedPoints add_points(Scene& scene, const AddedPointOptions& options,
                       const Progress& progress = {}, UsualValues* usual = nullptr);

} // namespace vcarve
