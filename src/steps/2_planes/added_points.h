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

/// A point that a scene shall get.
struct AcceptedPoint {
    Candidate candidate;
    std::vector<std::uint32_t> beside = {}; ///< the nearest points of its regions
    std::vector<std::uint32_t> track = {};  ///< the views that see it, ascending; two at least
};

/// The candidates that are right as far as points and sights tell, in their order. Each of them
/// must stand the following tests, which are the same whoever proposes it:
///
/// 1. No point of the scene is within three tenths of its step (of half a step amid a region).
/// 2. Of the eight points nearest to it five belong to its regions: nothing else stands there, and
///    a surface that bends does not go on.
/// 3. Two views see it. Those that saw the nearest points of its regions are asked; they must show
///    the place and stand before the planes of all its regions, or, where it stands out, of one.
///    Amid a region they must look at it, too (keep_views_that_look).
/// 4. Through its surface pass fewer sights than see it: where none is, one looks through. Of each
///    sight the spacing at its point is left out.
/// 5. No candidate that was accepted before it is within half a step.
///
/// Cost: O(log points) a candidate and O(log candidates) a sight, in parallel.
std::vector<AcceptedPoint> accept(const Scene& scene, const PlanarRegions& planes,
                                  std::vector<Candidate> candidates, const Progress& progress);

/// Leaves of the tracks of textureless points the views that look at them, as far as the model
/// tells: amid a region nothing but its plane says where a point is, so something may stand before
/// it. A view looks at a place if, of the points that it saw, the one that its image shows nearest
/// to the place is of the region; and if no other planar region covers the place before which the
/// view stands, as a roof does the ground: one that a line from the place along its plane's normal
/// meets from behind, within the hull of its points. Points with fewer than two views left are
/// dropped. Cost: O(sights log sights + points x views log points), in parallel, and 100 bytes a
/// sight of a view for each thread.
void keep_views_that_look(std::vector<AcceptedPoint>& points, const Scene& scene,
                          const PlanarRegions& planes, const Progress& progress);

/// Shows visit(from, to) the sight from a point to a view as a segment to the view. The margin (a
/// length) next to the point is left out, half of the sight at most, since points lie a little
/// before or behind the surface.
template <typename Visit>
void visit_sight(const Scene& scene, std::size_t point, std::uint32_t view, double margin,
                 const Visit& visit)
{
    constexpr double kMostOfSight = 0.5;
    const Eigen::Vector3d& center = scene.views[view].center;
    const Eigen::Vector3d way = center - scene.positions[point];
    const double length = way.norm();
    if (length == 0.0) return;
    const double left_out = std::min(margin / length, kMostOfSight);
    visit(scene.positions[point] + left_out * way, center);
}

/// How many sights of a scene, without the margins of their points (visit_sight()), pass through
/// each of some triangles. The tree is over the triangles, which are few; SightTree is the one over
/// all sights, for many questions. Cost: O(triangles log triangles + sights log triangles), in
/// parallel, and about 200 bytes a triangle.
std::vector<std::uint32_t> sights_through(const Scene& scene,
                                          std::span<const std::array<Eigen::Vector3d, 3>> triangles,
                                          const std::vector<double>& margins,
                                          const Progress& progress);

/// What was found and added.
struct AddedPoints {
    std::int64_t regions = 0; ///< planar ones of the surface
    std::int64_t added = 0;   ///< points
};

/// Adds points to the planar regions of the surface (planar_regions) where feature detectors find
/// few, so that the Delaunay triangulation cuts corners off or spans them and no labelling of its
/// cells can give them back: along creases (crease_candidates), along borders (border_candidates)
/// and on textureless areas (textureless_candidates), where accept() lets them stand. Point sets
/// are structured so by Lafarge & Alliez (2013), who know no views; here each point has sights,
/// which carve as others do. But behind a border there may be anything, so these points' sights say
/// nothing of what lies behind them (RayCaster).
///
/// A new point has the mean colour of the points beside it and the error of the one next to it.
/// Borders of dense clouds get none: points stand close enough there; nor do scans, which have
/// points wherever something was to be measured. The points follow each other
/// in space, as spatial_sort() puts them, before and after. The result does not depend on the
/// number of threads nor, up to rounding, on where the scene lies and how large it is. Cost: that
/// of the steps named and of a sort; 90 bytes a point, and what crossings take (border_candidates).
AddedPoints add_points(Scene& scene, const AddedPointOptions& options,
                       const Progress& progress = {});

} // namespace vcarve
