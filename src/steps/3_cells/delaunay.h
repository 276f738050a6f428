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

/// The number of a cell of CGAL's triangulation. New cells have none.
struct CellNumber {
    static constexpr Index kNone = 0xffffffffU;
    Index value = kNone;
};

/// CGAL's triangulation, whose vertices store the numbers of their points.
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<
                    CellNumber, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>>;

/// Returns all cells in CGAL's order, with vertices ordered as in TetMesh and neighbors by number.
/// Stores these numbers in CGAL's cells.
UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress = {});

/// Whether the sorted vertices of `a` precede those of `b`. Only the first two vertices may be
/// swapped.
bool comes_before(const Cell& a, const Cell& b);

/// Returns the cells whose smallest vertices are among the `num_vertices` from `first_vertex`, in
/// canonical order (see TetMesh). Other neighbors become CellNumber::kNone.
UnsetArray<Cell> in_canonical_order(const UnsetArray<Cell>& cells, Index first_vertex,
                                    std::size_t num_vertices, const Progress& progress = {});

/// Computes `mirrors` and `cell_of_vertex` from the positions and cells.
void complete(TetMesh& mesh);

/// Returns an insertion order for points in the order of spatial_sort(). It is random on a large
/// scale and local on a small scale (Amenta, Choi, Rote, "Incremental constructions con BRIO",
/// 2003).
UnsetArray<std::uint32_t> insertion_order(std::size_t count);

} // namespace vcarve
