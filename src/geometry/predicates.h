#pragma once

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// Sign of the volume of the tetrahedron a b c d, exact: +1 where a b c runs counter-clockwise seen
/// from d, -1 where clockwise, 0 where the four points lie in one plane.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);

/// Whether a, b and c lie on one line, exact.
bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether the segment from `from` to `to` meets a triangle, its border included, exact.
/// The triangle must have an area and the segment a length.
bool meets_triangle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    const std::array<Eigen::Vector3d, 3>& triangle);

} // namespace vcarve
