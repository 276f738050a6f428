#pragma once

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// The exact sign of the volume of the tetrahedron a b c d: +1 if a b c is counter-clockwise seen
/// from d, -1 if it is clockwise, and 0 if the four points are coplanar.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);

/// Whether a, b and c are collinear. Exact.
bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether the segment from `from` to `to` intersects a triangle or its boundary. Exact.
/// Precondition: the area of the triangle and the length of the segment are not zero.
bool meets_triangle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    const std::array<Eigen::Vector3d, 3>& triangle);

} // namespace vcarve
