#pragma once

#include "base/progress.h"
#include "base/unset_array.h"
#include "model/tet_mesh.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Core>

namespace vcarve {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

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

inline Kernel::Point_3 to_point(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

/// All cells in the order CGAL keeps them, with their vertices as TetMesh has them, their
/// neighbours by number in there. CGAL's cells are told these numbers.
UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress = {});

} // namespace vcarve
