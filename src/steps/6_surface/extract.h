#pragma once

#include "model/labels.h"
#include "model/tet_mesh.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// The boundary of the inside (Akgunduz, Zetu, Banerjee 2000, section 4.4): every facet between an
/// inside and an outside cell, counter-clockwise seen from outside, with the colours of the scene's
/// points. Closed, consistently oriented, possibly non-manifold where cells touch in an edge or a
/// vertex. Vertices and faces follow the order of the cells. Throws InputError where
/// there are more faces than can be numbered. Cost: O(cells), in parallel.
TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene);

/// The same where the boundary is at hand: face i is facet i.
TriMesh extract_surface(const TetMesh& cells, const std::vector<CellFacet>& facets,
                        const Scene& scene);

} // namespace vcarve
