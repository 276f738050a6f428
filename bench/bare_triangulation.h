#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_3.h>
#include <Eigen/Core>

#include <vector>

namespace vcarve::bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL's triangulation as its manual has it, with nothing of ours.
template <typename Concurrency>
using BareDelaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                                 CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
                                                 Concurrency>>;

inline std::vector<Kernel::Point_3> cgal_points(const std::vector<Eigen::Vector3d>& points)
{
    std::vector<Kernel::Point_3> result;
    result.reserve(points.size());
    for (const Eigen::Vector3d& p : points) {
        result.emplace_back(p.x(), p.y(), p.z());
    }
    return result;
}

} // namespace vcarve::bench
