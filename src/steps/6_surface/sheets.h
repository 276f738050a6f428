#pragma once

#include "mesh/vertex_faces.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// From which length of its longest edge on a face may be a sheet: `max_sheet` times the diameter
/// of what was looked at. Cost: as region_of_interest().
double sheet_edge(const Scene& scene, const SheetOptions& options);

/// Takes off the sheets with which the cut closes what was looked at towards its rim: the lid over
/// a hall without a ceiling, skirts from the edge of the ground, faces between far walls. They are
/// seen, but nothing was seen on them. A face goes whose longest edge is over `max_sheet` times the
/// diameter of what was looked at (region_of_interest) if views see less than half of it, or
/// nothing of it where it goes on with the small faces around one of its corners (trim.h). One with
/// an edge of twice that length also goes if it goes on with the small faces around none of its
/// corners, but only from the rim of the kept faces inwards, and from the hull; of three and a half
/// times that length if views see all of it. Then faces of any length go from the rim inwards of
/// which views see nothing. No face goes where a view would look onto the back of a
/// kept face through the gap. Repeated while sheets come to the rim. `boundary` is the surface of
/// `facets`, which ascend, face by face. Returns how many faces it took from `keep`. Cost: O(faces)
/// a round, and some walks a view for each long face and each at the rim; mostly in parallel.
std::int64_t peel_sheets(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                         const FaceVisibility& visibility, const SheetOptions& options,
                         FaceFlags& keep);

} // namespace vcarve
