#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vcarve {

/// A box along the axes.
struct Box {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
};

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

    /// So much products may be off that are too small for doubles.
    static constexpr double kTiny = std::numeric_limits<double>::min();

    Eigen::Vector3d corner_;
    double volume_ = 0.0; ///< D
    Eigen::Vector3d normal_;
    double volume_error_ = 0.0; ///< at most what D is off by
    Eigen::Vector3d normal_error_;
    Eigen::Vector3d center_; ///< from the corner, where D is positive
};

// What follows is asked some hundred times a point.

inline double SphereBound::least_in(const Box& box) const
{
    double least = -kTiny;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - corner_[axis];
        const double high = box.high[axis] - corner_[axis];
        const auto at = [&](double q) { return q * (volume_ * q - normal_[axis]); };
        // A parabola that opens upwards is least at the center, any other one at an end.
        least +=
            volume_ > 0.0 ? at(std::clamp(center_[axis], low, high)) : std::min(at(low), at(high));
        const double most = std::max(std::abs(low), std::abs(high));
        least -= most * (volume_error_ * most + normal_error_[axis]);
    }
    return least;
}

inline double SphereBound::least_at(const Eigen::Vector3d& point) const
{
    const Eigen::Vector3d q = point - corner_;
    const Eigen::Vector3d most = q.cwiseAbs();
    return q.dot(volume_ * q - normal_) - most.dot(volume_error_ * most + normal_error_) - kTiny;
}

} // namespace vcarve
