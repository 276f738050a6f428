#pragma once

#include "geometry/point_tree.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vcarve {

/// A polynomial that is negative inside the sphere around a tetrahedron, or beyond a plane, with a
/// bound of its rounding error. At a point q it is D |q - a|^2 - N (q - a). Here a is a corner, D
/// six times the volume, and N / 2 D the center relative to a. Without divisions, almost flat cells
/// are safe, too. Their center and radius would be noise, but here only their error bound is large.
class SphereBound {
  public:
    /// The sphere through the corners of a tetrahedron. Requires positive orientation(a, b, c, d).
    static SphereBound around(const std::array<Eigen::Vector3d, 4>& corners);
    /// The half space in which orientation(a, b, c, x) is positive.
    static SphereBound beyond(const std::array<Eigen::Vector3d, 3>& corners);

    /// The same for queries inside a box only. Most queries are then faster.
    SphereBound within(const Box& all) const;

    /// A lower bound of the polynomial in a box. If it is positive, no point of the box is inside.
    double least_in(const Box& box) const;
    /// The same for one point.
    double least_at(const Eigen::Vector3d& point) const;

    /// Whether every point of the sphere is closer than `distance` to each corner.
    bool is_within(double distance) const;

  private:
    template <typename Number>
    static SphereBound computed(const std::array<Eigen::Vector3d, 4>& corners);

    bool is_flat() const;
    double error_in(const Box& box) const;

    /// A bound of the error of products that underflow.
    static constexpr double kTiny = std::numeric_limits<double>::min();

    Eigen::Vector3d corner_;
    double volume_ = 0.0; ///< D
    Eigen::Vector3d normal_;
    double volume_error_ = 0.0; ///< bound of the error of D
    Eigen::Vector3d normal_error_;
    Eigen::Vector3d center_; ///< relative to the corner; set if D is positive
    double most_error_ = std::numeric_limits<double>::infinity(); ///< error bound, see within()
};

// The following functions are called some hundred times per point.

/// A bound of the rounding error at any point of a box.
inline double SphereBound::error_in(const Box& box) const
{
    const Eigen::Vector3d most =
        (box.low - corner_).cwiseAbs().cwiseMax((box.high - corner_).cwiseAbs());
    return most.dot(volume_error_ * most + normal_error_) + kTiny;
}

inline double SphereBound::least_in(const Box& box) const
{
    const Eigen::Vector3d low = box.low - corner_;
    const Eigen::Vector3d high = box.high - corner_;
    const auto at = [&](double q, int axis) { return q * (volume_ * q - normal_[axis]); };
    double least = 0.0;
    // A parabola that opens upwards has its minimum at the center, any other at an end.
    for (int axis = 0; axis < 3; ++axis) {
        least += volume_ > 0.0 ? at(std::clamp(center_[axis], low[axis], high[axis]), axis)
                               : std::min(at(low[axis], axis), at(high[axis], axis));
    }
    return least - (least > most_error_ ? most_error_ : error_in(box));
}

inline double SphereBound::least_at(const Eigen::Vector3d& point) const
{
    const Eigen::Vector3d q = point - corner_;
    const double least = q.dot(volume_ * q - normal_);
    return least - (least > most_error_ ? most_error_ : error_in({point, point}));
}

} // namespace vcarve
