#pragma once

#include "base/progress.h"
#include "steps/2_planes/candidate.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

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

} // namespace vcarve
