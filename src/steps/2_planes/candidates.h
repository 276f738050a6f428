#pragma once

#include "base/progress.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How far a candidate stands off its plane at most, in steps: among points in one plane rounding
/// would tell which cells there are.
inline constexpr double kOffPlane = 1e-3;

/// A place where a point may be added, as a generator proposes it.
struct Candidate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    PointKind kind = PointKind::crease;
    double step = 0.0;                         ///< how far apart such points stand
    std::array<std::uint32_t, 2> regions = {}; ///< whose it is: two that meet, or one twice
    bool stands_out = false; ///< as the edge of a box does, before either of the regions' planes
    /// Pieces of the surface that there would be.
    std::vector<std::array<Eigen::Vector3d, 3>> surface = {};
};

/// Places along the creases of the surface, where two planar regions meet: at the foot of a wall,
/// in the corner of a room, along the edge of a box. After Lafarge & Alliez (2013), who put points
/// along the lines where planes meet if points of both are near; here they may be far, since sights
/// tell where one looks through.
///
/// Two regions whose planes stand at 30 degrees or more to each other meet along a line. It gets a
/// place every seven tenths of the larger of their spacings where both have points within `reach`
/// spacings of it, to both sides along it. The surface that there would be are two strips, as wide
/// as the step, to the nearest points of either. In an order that does not depend on the threads.
/// Cost: O(log points) for each point of a region that lies near another, in parallel.
std::vector<Candidate> crease_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double reach, const Progress& progress);

/// Places along the borders of planar regions, where one ends since sights pass by, as at the eaves
/// of a roof over a plain wall, of which no point is known: there is no crease. A border is where
/// points and crossings of the plane by sights are neighbours, in the plane's Delaunay
/// triangulation. (Borders in point sets: Bendels, Schnabel & Klein 2006, by the angle that the
/// points around leave free; that tells where points end, not that one looks past them.)
///
/// Of a region of 20 points or more the crossings of its plane within `gap` spacings of its points
/// are looked up, of the sights to the first and the last view of each point, since those between
/// pass between them; of a sight the spacing at its point is left out. Each edge of the
/// triangulation from a point to a crossing that is no longer than `gap` gets a place at three
/// tenths of the way. Region by region, those next to their points first, in an order that does not
/// depend on the threads; many stand closer to each other than their steps. Cost: O(sights log
/// regions + crossings log crossings), in parallel, and 24 bytes a crossing.
std::vector<Candidate> border_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double gap, const Progress& progress);

/// Places on textureless areas, amid planar regions: a plain floor, or the road between cars, where
/// views look but images show no features. Chauve, Labatut & Pons (2010) complete planes so, by
/// cells of their arrangement; here a plane goes on within the convex hull of its points alone,
/// since the truth ends somewhere, too.
///
/// The plane of a region of 100 points or more is divided into squares with sides of `step`
/// spacings. Those within the hull that have none of its points get a place near their middle,
/// those next to points first, no more than there are points. The surface that there would be is
/// the square. Region by region, in an order that does not depend on the threads. Cost: O(points
/// log points), in parallel over the regions.
std::vector<Candidate> textureless_candidates(const PlanarRegions& planes, double step,
                                              const Progress& progress);

} // namespace vcarve
