#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// What was found and added.
struct CreaseReport {
    std::int64_t planes = 0;        ///< flat parts of the surface
    std::int64_t added = 0;         ///< points
    std::int64_t along_borders = 0; ///< of those
    std::int64_t in_blanks = 0;     ///< of those
};

/// Adds points along the creases where two flat parts of the surface meet, at the foot of a wall,
/// in a corner of a room, along the edge of a box, along the borders where one ends, and amid one
/// where it is blank. Feature detectors find few points there, so that the Delaunay triangulation
/// cuts corners off or spans them, and no labelling of its cells can give them back. (Point sets
/// are structured so by Lafarge & Alliez 2013, who know no views.)
///
/// Two planar regions (planar_regions) whose planes stand at 30 degrees or more to each other meet
/// along a line. It gets a point every seven tenths of their spacing where both have points within
/// `reach` spacings of it to both sides along it, where most of the points around are theirs and
/// none is there yet. Its views are those that saw the nearest points of both, if they show the
/// place and stand before both planes, or, where the edge stands out, before one; fewer than two
/// make no point. Nor does a place through whose strips of surface, from there to the nearest
/// points of either region, as many sights pass as come from there.
///
/// A planar region of 20 points or more ends between its points and the places where sights pass
/// through its plane. Of each two of these that are neighbours in the plane's Delaunay
/// triangulation and no farther apart than `border_gap` spacings, the way from the point to the
/// passage gets a point at three tenths, where most of the points around are the region's (a
/// surface that bends goes on) and none is near. Its views are those that saw the region's two
/// points nearest to it, if they show the place and stand before the plane. Behind a border there
/// may be anything, so these points' sights carve and say nothing of what lies behind them
/// (RayCaster).
///
/// Amid a planar region of 100 points or more, within their convex hull, its plane is divided into
/// squares with sides of `blank_step` spacings. One without points of the region gets one near
/// its middle if none of the scene's is near, if no sight passes through it, if at least two views
/// look at it, and if it hangs together with the region's points by such squares, of which as many
/// are asked as the region has points. The views that are asked are those that saw the region's
/// four points nearest to it, if they show the place and stand before the plane, but not those that
/// stand before a flat part which covers the place, as a roof does the ground (Covers); whether
/// they look at it what their images show beside it tells (ShownPoints).
///
/// A new point has the error of the point next to it and its colour, amid a region the mean colour
/// of the region's four nearest, and the id kNoPointId along a
/// crease, kBorderPointId along a border, kBlankPointId amid a region. Scenes with points whose
/// error is not known, which are dense, stay as they are. The points follow each other in space, as
/// spatial_sort() puts them, before and after. The result does not depend on the number of threads
/// nor, up to rounding, on where the scene lies and how large it is. Cost: that of planar_regions,
/// of crease_places, sights_through, border_places and blank_places, and of a sort; 90
/// bytes a point, and what passages take (border_places).
CreaseReport add_crease_points(Scene& scene, const CreaseOptions& options,
                               const Progress& progress = {});

} // namespace vcarve
