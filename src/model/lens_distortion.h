#pragma once

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// How a lens moves a point m of the image plane at focal length 1, with s = m . m:
///
///     m N(s) / D(s) + s q + 2 (q . m) m + s a + s^2 b
///
/// N = 1 + k1 s + k2 s^2 + ... and D alike are the radial part, q the tangential (Brown, 1971), a
/// and b the thin prism's. All coefficients are without unit.
struct LensDistortion {
    std::array<double, 6> radial{};  ///< k1, k2, ... of N
    std::array<double, 3> divisor{}; ///< of D
    /// q, which is (p2, p1) in OpenCV's names.
    Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
    Eigen::Vector2d prism_s = Eigen::Vector2d::Zero();  ///< a
    Eigen::Vector2d prism_ss = Eigen::Vector2d::Zero(); ///< b
    bool divides = false;                               ///< whether D is anything but 1
    bool in_sequence = false; ///< q, a and b act on m N / D, not on m itself
};

/// Where the lens moves a point. Cost: some forty multiplications.
Eigen::Vector2d distort(const LensDistortion& lens, const Eigen::Vector2d& point);

/// Whether no two points on the line from the centre to `point` are moved equally far out. A
/// polynomial turns somewhere, often not far outside the image, and beyond would bring points from
/// far off the axis back into it; no lens does that. Only distances along the line are looked at,
/// not how q, a and b move points across it. Cost: some forty multiplications for a point well
/// before the turn, a hundred more with a divisor, at most some ten thousand near it or beyond.
bool before_turn(const LensDistortion& lens, const Eigen::Vector2d& point);

/// The point before the turn that distort() moves to `target`, by Newton's method. Where there is
/// none, it is some other point: compare what distort() makes of it. Cost: some five steps, each of
/// distort() and before_turn(), at most 50.
Eigen::Vector2d undistort(const LensDistortion& lens, const Eigen::Vector2d& target);

} // namespace vcarve
