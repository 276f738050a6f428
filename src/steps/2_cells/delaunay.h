#pragma once

#include "model/tet_mesh.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Core>

#include <array>
#include <utility>

namespace vcarve {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// What a cell of CGAL's triangulation is told beside its corners. New ones have no number.
struct CellNumber {
    static constexpr Index kNone = 0xffffffffU;
    Index value = kNone;
};

/// CGAL's triangulation, whose vertices know the numbers of their points.
template <typename Concurrency>
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<
                CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>,
                CGAL::Triangulation_cell_base_with_info_3<
                    CellNumber, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>,
                Concurrency>>;

inline Kernel::Point_3 to_point(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

/// A cell with its vertices as TetMesh has them, its neighbours by the numbers that CGAL's cells
/// were given.
template <typename CellHandle>
Cell unordered_cell(const CellHandle& cell)
{
    std::array<int, 4> sources = {0, 1, 2, 3};
    std::array<Index, 4> found{};
    for (int i = 0; i < 4; ++i) {
        found[i] = cell->vertex(i)->info();
    }
    // Sort by exchanging; each exchange turns the cell inside out, and one more may turn it back.
    bool is_odd = false;
    for (int i = 1; i < 4; ++i) {
        for (int j = i; j > 0 && found[sources[j]] < found[sources[j - 1]]; --j) {
            std::swap(sources[j], sources[j - 1]);
            is_odd = !is_odd;
        }
    }
    if (is_odd) {
        std::swap(sources[0], sources[1]);
    }
    Cell result{};
    for (int i = 0; i < 4; ++i) {
        result.vertices[i] = found[sources[i]];
        result.neighbors[i] = cell->neighbor(sources[i])->info().value;
    }
    return result;
}

} // namespace vcarve
