#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Core>

namespace vcarve {

/// Exact predicates, rounded constructions.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Kernel::Point_3 to_cgal(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

/// Rounded predicates, which are faster.
using Cartesian = CGAL::Simple_cartesian<double>;

inline Cartesian::Point_3 to_cartesian(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

} // namespace vcarve
