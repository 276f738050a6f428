#pragma once

#include "geometry/predicates.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace vcarve {

/// A point as seen along a sight: sheared along it onto the plane across its longest axis.
struct Sighted {
    double x = 0.0;
    double y = 0.0;
    double depth = 0.0; ///< along the longest axis, 0 at the sight's point, 1 at its target
    double size = 0.0;  ///< largest coordinate difference to the sight's point, for error bounds
};

/// The plane across a sight (Woop, Benthin, Wald, "Watertight ray/triangle intersection", JCGT
/// 2013). Seen in it the sight is the origin, and a triangle that runs counter-clockwise seen from
/// the sight's point runs counter-clockwise. Which side of the sight an edge passes on is the sign
/// of a 2x2 determinant; where rounding could turn it, the exact predicate answers instead.
class SightFrame {
  public:
    SightFrame() = default;
    SightFrame(const Eigen::Vector3d& point, const Eigen::Vector3d& target)
        : point_(point), target_(target)
    {
        const Eigen::Vector3d along = target - point;
        along.cwiseAbs().maxCoeff(&axis_);
        axis_x_ = (axis_ + 1) % 3;
        axis_y_ = (axis_ + 2) % 3;
        if (along[axis_] > 0.0) {
            std::swap(axis_x_, axis_y_);
        }
        near_ = {point[axis_x_], point[axis_y_], point[axis_]};
        inverse_ = 1.0 / along[axis_];
        shear_x_ = along[axis_x_] * inverse_;
        shear_y_ = along[axis_y_] * inverse_;
    }

    const Eigen::Vector3d& point() const { return point_; }
    const Eigen::Vector3d& target() const { return target_; }

    Sighted project(const Eigen::Vector3d& p) const
    {
        const double x = p[axis_x_] - near_.x();
        const double y = p[axis_y_] - near_.y();
        const double along = p[axis_] - near_.z();
        return {x - shear_x_ * along, y - shear_y_ * along, along * inverse_,
                std::max({std::abs(x), std::abs(y), std::abs(along)})};
    }

    /// +1 where the sight's origin lies left of the way from a to b (seen from the sight's point),
    /// -1 right of it, 0 where the sight's line and the edge lie in one plane. Exact. p and q are
    /// the projections of a and b.
    int turn(const Sighted& p, const Sighted& q, const Eigen::Vector3d& a,
             const Eigen::Vector3d& b) const
    {
        const double determinant = p.x * q.y - p.y * q.x;
        if (std::abs(determinant) > error_bound(p, q)) {
            return determinant > 0.0 ? 1 : -1;
        }
        return -orientation(point_, target_, a, b);
    }

    /// turn() from each of three projections to one, where rounding leaves no sign open: bit k is
    /// set where that of from[k] is +1. Otherwise negative. Without branches on the signs, which no
    /// processor foresees.
    int clear_turns(const std::array<Sighted, 3>& from, const Sighted& to) const
    {
        int left = 0;
        std::array<double, 3> magnitudes{};
        double size = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double determinant = from[k].x * to.y - from[k].y * to.x;
            left |= static_cast<int>(determinant > 0.0) << k;
            magnitudes[k] = std::abs(determinant);
            size = std::max(size, from[k].size);
        }
        // What is not a number is not clear.
        const double bound = kRounding * size * to.size;
        int is_clear = 1;
        for (const double magnitude : magnitudes) {
            is_clear &= static_cast<int>(magnitude > bound);
        }
        return is_clear != 0 ? left : -1;
    }

  private:
    /// Each coordinate is off by at most 6 roundings of `size`, so a determinant by at most 64.
    static constexpr double kRounding = 1e-14;

    static double error_bound(const Sighted& p, const Sighted& q)
    {
        return kRounding * p.size * q.size;
    }

    Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d near_ =
        Eigen::Vector3d::Zero(); ///< coordinates of the point, in the order x, y, along
    int axis_ = 0;
    int axis_x_ = 1;
    int axis_y_ = 2;
    double inverse_ = 0.0;
    double shear_x_ = 0.0;
    double shear_y_ = 0.0;
};

} // namespace vcarve
