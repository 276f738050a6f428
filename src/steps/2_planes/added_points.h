#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

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
