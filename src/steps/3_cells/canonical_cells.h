#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"

#include <cstddef>

namespace vcarve {

/// Whether the sorted vertices of a cell come first. Only the first two may stand exchanged.
bool comes_before(const Cell& a, const Cell& b);

/// The cells whose smallest vertices are among the `num_vertices` ones from `first_vertex` on, in
/// canonical order, see TetMesh. A neighbour that is none of them becomes CellNumber::kNone.
UnsetArray<Cell> in_canonical_order(const UnsetArray<Cell>& cells, Index first_vertex,
                                    std::size_t num_vertices, const Progress& progress = {});

/// Fills what follows from positions and cells: `mirrors` and `cell_of_vertex`.
void complete(TetMesh& mesh);

} // namespace vcarve
