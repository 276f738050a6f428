#pragma once

#include "base/progress.h"

#include <cstdint>

namespace vcarve {

class HalfEdgeMesh;

/// Flips edges of ridges, where two faces meet that the solid lies behind, as long as the surface
/// bends less afterwards: the sum of the angles between the normals of the two faces, and between
/// them and the four beside, falls by .2 radians. So ridges that run zigzag over the cells run
/// straight. (Dyn, Hormann, Kim, Levin, "Optimizing 3D triangulations using discrete curvature
/// analysis", 2001.) A flipped ridge takes the tetrahedron of its two faces off the solid, hence no
/// sight that was free is blocked afterwards. Neither the faces before nor those after may turn by
/// more than 80 degrees from each other, or thin things would be cut through. The flip that gains
/// most comes first. Vertices stay, and so do rims; normals are made anew. How many edges were
/// flipped. Cost: O(edges), in parallel, and O(log edges) a flip; 24 bytes a face and 8 an edge.
std::int64_t flip_ridges(HalfEdgeMesh& mesh, const Progress& progress = {});

} // namespace vcarve
