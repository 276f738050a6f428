#pragma once

#include "base/arrays.h"
#include "base/progress.h"
#include "geometry/cgal_kernel.h"
#include "model/tet_mesh.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>

namespace vcarve {

/// What a cell of CGAL's triangulation is told beside its corners. New ones have no number.
struct CellNumber {
    static constexpr Index kNone = 0xffffffffU;
    Index value = kNone;
};

/// CGAL's triangulation, whose vertices know the numbers of their points.
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<
                    CellNumber, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;

/// All cells in the order CGAL keeps them, with their vertices as TetMesh has them, their
/// neighbours by number in there. CGAL's cells are told these numbers.
UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress = {});

/// Whether the sorted vertices of a cell come first. Only the first two may stand exchanged.
bool comes_before(const Cell& a, const Cell& b);

/// The cells whose smallest vertices are among the `num_vertices` ones from `first_vertex` on, in
/// canonical order, see TetMesh. A neighbour that is none of them becomes CellNumber::kNone.
UnsetArray<Cell> in_canonical_order(const UnsetArray<Cell>& cells, Index first_vertex,
                                    std::size_t num_vertices, const Progress& progress = {});

/// Fills what follows from positions and cells: `mirrors` and `cell_of_vertex`.
void complete(TetMesh& mesh);

/// The numbers of points that follow each other in space, in the order that suits insertion: random
/// at large, near each other in the small (Amenta, Choi, Rote, "Incremental constructions con
/// BRIO", 2003).
UnsetArray<std::uint32_t> insertion_order(std::size_t count);

} // namespace vcarve
