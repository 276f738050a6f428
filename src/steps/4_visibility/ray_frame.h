#pragma once

#include "geometry/predicates.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace vcarve {

/// A point in the frame of a ray: sheared along it onto the plane normal to its longest axis.
struct Rayed {
    double x = 0.0;
    double y = 0.0;
    double depth = 0.0; ///< along the longest axis, 0 at the ray's point, 1 at its target
    double size = 0.0;  ///< largest coordinate difference to the ray's point, for error bounds
};

/// The projection along a ray (Woop, Benthin, Wald, "Watertight ray/triangle intersection", JCGT
/// 2013). The ray projects to the origin. Triangles that are counter-clockwise seen from the ray's
/// point stay so. The side on which the ray passes an edge is the sign of a 2x2 determinant. If
/// rounding could change it, the exact predicate decides.
class RayFrame {
  public:
    RayFrame() = default;
    RayFrame(const Eigen::Vector3d& point, const Eigen::Vector3d& target)
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

    Rayed project(const Eigen::Vector3d& p) const
    {
        const double x = p[axis_x_] - near_.x();
        const double y = p[axis_y_] - near_.y();
        const double along = p[axis_] - near_.z();
        return {x - shear_x_ * along, y - shear_y_ * along, along * inverse_,
                std::max({std::abs(x), std::abs(y), std::abs(along)})};
    }

    /// +1 if the ray passes left of the edge from a to b (seen from the ray's point), -1 if right,
    /// 0 if the ray's line and the edge are coplanar. Exact. p and q are the projected a and b.
    int turn(const Rayed& p, const Rayed& q, const Eigen::Vector3d& a,
             const Eigen::Vector3d& b) const
    {
        const double determinant = p.x * q.y - p.y * q.x;
        if (std::abs(determinant) > error_bound(p, q)) {
            return determinant > 0.0 ? 1 : -1;
        }
        return -orientation(point_, target_, a, b);
    }

    /// The signs of turn() from three projections to one: bit k is set if from[k] has +1. Negative
    /// if rounding leaves a sign uncertain. Branchless, because the signs are unpredictable.
    int clear_turns(const std::array<Rayed, 3>& from, const Rayed& to) const
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
        // NaN is not clear.
        const double bound = kRounding * size * to.size;
        int is_clear = 1;
        for (const double magnitude : magnitudes) {
            is_clear &= static_cast<int>(magnitude > bound);
        }
        return is_clear != 0 ? left : -1;
    }

  private:
    /// Coordinates are off by at most 6 roundings of `size`, so determinants by at most 64.
    static constexpr double kRounding = 1e-14;

    static double error_bound(const Rayed& p, const Rayed& q)
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
