#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// Finds walls without points inside, outlined only by points along their foot, top and corners.
/// `open` contains infinite cells labeled outside, whose hull facets are seen from within. A wall
/// is a set of these facets
///   - in one plane, within 2 % of the extent of the wall, through at least 6 points,
///   - upright within 30 degrees, by up_of(), because a bare ceiling looks like the sky,
///   - with faces between inside and outside cells along .6 of the outline, which is more than two
///     sides of a triangle in an open corner,
///   - and seen by at least 3 views through outside cells.
/// Returns their cells, large facets first. Cost: O(open log open + cells), and walks from up to 10
/// samples of each facet to the views, for walls that meet all other conditions.
std::vector<Index> plain_walls(const TetMesh& cells, const Scene& scene,
                               const std::vector<Index>& open, const Labels& labels);

} // namespace vcarve
