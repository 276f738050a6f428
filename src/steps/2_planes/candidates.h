#pragma once

#include "base/progress.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Maximum distance of a candidate from its plane, in steps. Among coplanar points, rounding would
/// decide which cells exist.
inline constexpr double kOffPlane = 1e-3;

/// A position where a point may be added.
struct Candidate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    PointKind kind = PointKind::crease;
    double step = 0.0;                         ///< distance between such points
    std::array<std::uint32_t, 2> regions = {}; ///< the two regions that meet, or one region twice
    bool stands_out = false;                   ///< a convex crease, such as the edge of a box
    /// Triangles of the surface that the point would cause.
    std::vector<std::array<Eigen::Vector3d, 3>> surface = {};
};

/// Returns candidates along creases, where two planar regions meet. Examples are the foot of a
/// wall, the corner of a room, and the edge of a box. Lafarge & Alliez (2013) add points along the
/// intersection of planes if points of both are near. Here points may be far, because rays reveal
/// openings.
///
/// Two regions are intersected if their planes meet at 30 degrees or more. Candidates are .7 of the
/// larger spacing apart on the line. Each needs points of both regions within `reach` spacings, in
/// both directions along the line. Its surface consists of two strips, as wide as the step, to the
/// nearest points of both regions. The order does not depend on the thread count. Cost: O(log
/// points) for each point of a region near another, in parallel.
std::vector<Candidate> crease_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double reach, const Progress& progress);

/// Returns candidates along borders, where rays pass beside a planar region. The eaves of a
/// roof over a plain wall without points are an example; no crease is there. At a border, points
/// and crossings of the plane by rays are neighbors in the plane's Delaunay triangulation.
/// (Bendels, Schnabel & Klein 2006 detect borders of point sets by the largest angle without
/// points. This shows where points end, but not that rays pass.)
///
/// Regions of at least 20 points are searched for crossings of their plane within `gap` spacings of
/// their points. Only rays to the first and the last view of each point are tested, because the
/// others are between them. The part of a ray within one spacing of its point is omitted. Each edge
/// of the triangulation from a point to a crossing, of at most `gap` spacings, gets a candidate at
/// .3 of its length. Candidates are sorted by region and distance to the point, for any thread
/// count. Many are closer to each other than their steps. Cost: O(rays log regions + crossings log
/// crossings), in parallel, and 24 bytes per crossing.
std::vector<Candidate> border_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double gap, const Progress& progress);

/// Returns candidates in textureless areas of planar regions, such as a plain floor or the road
/// between cars, where images show no features. Chauve, Labatut & Pons (2010) complete planes by
/// cells of their arrangement. Here a plane continues only within the convex hull of its points,
/// because real surfaces are bounded, too.
///
/// The plane of a region of at least 100 points is divided into squares with sides of `step`
/// spacings. Squares within the hull and without points get a candidate near their center, those
/// next to points first. There are at most as many as points. The surface is the square. Candidates
/// are sorted by region, for any thread count. Cost: O(points log points), in parallel over the
/// regions.
std::vector<Candidate> textureless_candidates(const PlanarRegions& planes, double step,
                                              const Progress& progress);

} // namespace vcarve
