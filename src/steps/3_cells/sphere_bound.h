#pragma once

#include "geometry/point_tree.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vcarve {

/// How far inside the sphere around a tetrahedron a point lies, or how far beyond a plane: a
/// polynomial that is negative there, with a bound of what rounding adds. It has the signs of
/// D |q - a|^2 - N (q - a), where a is a corner, D six times the volume and N / 2 D the center seen
/// from a. So nothing is divided, and cells without a volume to speak of, whose center and radius
/// would be noise, are safe too: their bound is large, and tells nothing.
class SphereBound {
  public:
    /// Of the sphere through the corners of a tetrahedron; orientation(a, b, c, d) is positive.
    static SphereBound around(const std::array<Eigen::Vector3d, 4>& corners);
    /// Of the half space in which orientation(a, b, c, x) is positive.
    static SphereBound beyond(const std::array<Eigen::Vector3d, 3>& corners);

    /// The same, asked only about what lies in a box. Most is told sooner then.
    SphereBound within(const Box& all) const;

    /// At most what the polynomial is at any point of a box. Where it is positive, no point in
    /// there is inside.
    double least_in(const Box& box) const;
    /// The same of one point.
    double least_at(const Eigen::Vector3d& point) const;

    /// Whether all of the sphere lies nearer to each corner than so far.
    bool is_within(double distance) const;

  private:
    template <typename Number>
    static SphereBound computed(const std::array<Eigen::Vector3d, 4>& corners);

    bool is_flat() const;
    double error_in(const Box& box) const;

    /// So much products may be off that are too small for doubles.
    static constexpr double kTiny = std::numeric_limits<double>::min();

    Eigen::Vector3d corner_;
    double volume_ = 0.0; ///< D
    Eigen::Vector3d normal_;
    double volume_error_ = 0.0; ///< at most what D is off by
    Eigen::Vector3d normal_error_;
    Eigen::Vector3d center_; ///< from the corner, where D is positive
    double most_error_ = std::numeric_limits<double>::infinity(); ///< where it will be asked about
};

// What follows is asked some hundred times a point.

/// At most what rounding adds at any point of a box.
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
    // A parabola that opens upwards is least at the center, any other one at an end.
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
