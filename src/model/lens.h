#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string_view>

namespace vcarve {

/// How a lens brings directions to its image plane, before any polynomial moves them there.
enum class LensGeometry {
    perspective,     ///< by the tangent of the angle to the axis
    fisheye,         ///< by the angle itself
    fov,             ///< Devernay and Faugeras, 2001
    division,        ///< Fitzgibbon, 2001
    unified,         ///< the enhanced unified model; Khomutenko, Garcia and Martinet, 2016
    equirectangular, ///< longitude and latitude
};

/// One of COLMAP's camera models. Its parameters are its focal lengths, the principal point unless
/// it has no focal length, and then what distorts.
struct LensModel {
    int number = 0;             ///< in binary files
    std::string_view name;      ///< in cameras.txt
    std::size_t num_params = 0; ///< all of them
    std::size_t num_focals = 0; ///< 1, 2 for the two axes, or 0
    LensGeometry geometry = LensGeometry::perspective;
    bool polynomial = false; ///< a LensDistortion follows
};

/// The model with this number, or null where COLMAP (4.2, and the two models it got since) has none
/// such. Cost: O(1).
const LensModel* lens_model(int number);

/// The model with this name, or null.
const LensModel* lens_model(std::string_view name);

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
