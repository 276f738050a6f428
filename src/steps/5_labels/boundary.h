#pragma once

#include "model/labels.h"
#include "model/tet_mesh.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// All facets between an inside and an outside cell, given from the inside one, in the order of the
/// cells; those between two infinite cells, which have no end, are left out. Cost: O(cells), in
/// parallel.
std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels);

/// The corners of a facet, counter-clockwise seen from outside its cell.
Face face_of(const TetMesh& cells, const CellFacet& facet);

/// Where a facet stands among those of a boundary, which are in the order of the cells.
/// Precondition: it is one of them. Cost: O(log facets).
std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets);

/// The facets as faces over the vertices of the cells, counter-clockwise seen from outside. Throws
/// InputError where there are too many to number.
std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets);

/// Calls all infinite cells outside, so that the boundary is closed. Cost: O(cells).
void close_hull(const TetMesh& cells, Labels& labels);

} // namespace vcarve
