#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
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

/// The infinite cells into which no sight leaves the hull, ascending. `network` holds what the
/// sights say and nothing else yet. Cost: O(cells), in parallel.
std::vector<Index> uncrossed_hull_cells(const TetMesh& cells, const FlowNetwork& network);

/// Lets the surface go on along the hull. Where points are seen from within the hull only, as on
/// the walls of a room or at the rim of a plain, no cell lies behind them but infinite ones, which
/// the cut takes for outside; so the surface would end there. Of the `uncrossed` cells those are
/// called inside before which an outside cell lies, whose facet of the hull is seen from within (at
/// each corner) and from beyond by none (no view there saw a corner or has it in its image), is at
/// most `hull_edge` times as long as the edges around, and goes on with the surface at one corner
/// or more (goes_on), or belongs to a wall without points of its own (plain_walls). Then the
/// boundary has such facets of the hull, and borders where they end. Returns how many there are.
/// Cost: O(uncrossed x views) at most, in parallel, and the boundary of the labels.
std::int64_t go_on_along_hull(const TetMesh& cells, const Scene& scene,
                              const std::vector<Index>& uncrossed, const HullOptions& options,
                              Labels& labels);

} // namespace vcarve
