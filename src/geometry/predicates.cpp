#include "geometry/predicates.h"

#include "geometry/cgal_kernel.h"

#include <CGAL/intersections.h>

namespace vcarve {

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d)
{
    return static_cast<int>(CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)));
}

bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
    return CGAL::collinear(to_cgal(a), to_cgal(b), to_cgal(c));
}

bool meets_triangle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    const std::array<Eigen::Vector3d, 3>& triangle)
{
    const auto& [a, b, c] = triangle;
    return CGAL::do_intersect(Kernel::Triangle_3(to_cgal(a), to_cgal(b), to_cgal(c)),
                              Kernel::Segment_3(to_cgal(from), to_cgal(to)));
}

} // namespace vcarve
