#include "baselines/circumsphere.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace vcarve {

Circumsphere circumsphere(const TetMesh& cells, Index cell)
{
    Circumsphere none{Eigen::Vector3d::Zero(), std::numeric_limits<double>::infinity()};
    if (cells.cells[cell].is_infinite()) return none;
    const std::array<Index, 4>& corners = cells.cells[cell].vertices;
    const Eigen::Vector3d& base = cells.positions[corners[0]];
    const Eigen::Vector3d a = cells.positions[corners[1]] - base;
    const Eigen::Vector3d b = cells.positions[corners[2]] - base;
    const Eigen::Vector3d c = cells.positions[corners[3]] - base;
    // As far from the base as from the three others: x . a = a . a / 2, and so on.
    const Eigen::Vector3d numerator =
        a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
    const Eigen::Vector3d offset = numerator / (2.0 * a.dot(b.cross(c)));
    const double radius = offset.norm();
    if (!std::isfinite(radius)) return none;
    return {base + offset, radius};
}

} // namespace vcarve
