#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <vector>

namespace vcarve {

/// Finds walls without points of their own, which only points along their foot, top and corners
/// outline. `open` holds infinite cells labelled outside, whose facets of the hull are seen from
/// within; those facets are a wall that
///   - lie in one plane, within 2 % of how far they reach, through at least 6 points,
///   - stand upright, within 30 degrees, by up_of(): a bare ceiling looks like the sky,
///   - are held along .6 of their outline by faces between inside and outside cells: more than the
///     two sides of a triangle in an open corner can be,
///   - and are seen by at least 3 views through outside cells.
/// Returns their cells, those of large facets first. Cost: O(open log open + cells), and for each
/// group of facets with such an outline walks from 7 places on each to the views.
std::vector<Index> plain_walls(const TetMesh& cells, const Scene& scene,
                               const std::vector<Index>& open, const Labels& labels);

} // namespace vcarve
