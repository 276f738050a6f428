#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// All facets between an inside and an outside cell, given from the inside cell, in the order of
/// the cells. Facets between two infinite cells are unbounded and left out. Cost: O(cells), in
/// parallel.
std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels);

/// The corners of a facet, counter-clockwise seen from outside its cell.
Face face_of(const TetMesh& cells, const CellFacet& facet);

/// The index of a facet in a boundary, which is in the order of the cells. Precondition: the
/// boundary contains the facet. Cost: O(log facets).
std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets);

/// The facets as faces over the vertices of the cells, counter-clockwise seen from outside. Throws
/// InputError if there are too many for 32-bit indices.
std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets);

/// Labels all infinite cells outside, so that the boundary is closed. Cost: O(cells).
void close_hull(const TetMesh& cells, Labels& labels);

/// The infinite cells into which no ray leaves the hull, ascending. `network` must contain the
/// terms of rays only. Cost: O(cells), in parallel.
std::vector<Index> uncrossed_hull_cells(const TetMesh& cells, const FlowNetwork& network);

/// Continues the surface along the hull. Points seen only from within the hull, as on the walls of
/// a room or the rim of a plain, have only infinite cells behind them. The cut labels these
/// outside, so the surface would end there. An `uncrossed` cell becomes inside if the cell in front
/// of its hull facet is outside, and the facet
///   - is seen from within at each corner; no view beyond it saw a corner or has it in its image,
///   - has edges of at most `hull_edge` times the local length, and continues the surface at a
///     corner (continues_surface()), or belongs to a wall without points inside (plain_walls()).
/// Returns the number of these facets, which then are in the boundary and may end in borders. Cost:
/// O(uncrossed x views) at most, in parallel, and the boundary of the labels.
std::int64_t continue_along_hull(const TetMesh& cells, const Scene& scene,
                                 const std::vector<Index>& uncrossed, const HullOptions& options,
                                 Labels& labels);

} // namespace vcarve
