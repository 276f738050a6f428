#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string_view>

namespace vcarve {

/// The projection of directions to the image plane, before polynomial distortion.
enum class LensGeometry {
    perspective,     ///< radius = tangent of the angle to the axis
    fisheye,         ///< radius = the angle
    fov,             ///< Devernay and Faugeras, 2001
    division,        ///< Fitzgibbon, 2001
    unified,         ///< the enhanced unified model; Khomutenko, Garcia and Martinet, 2016
    equirectangular, ///< longitude and latitude
};

/// One of COLMAP's camera models. Its parameters are focal lengths, the principal point (if
/// there are focal lengths), and distortion parameters.
struct LensModel {
    int number = 0;             ///< in binary files
    std::string_view name;      ///< in cameras.txt
    std::size_t num_params = 0; ///< number of all parameters
    std::size_t num_focals = 0; ///< 1, 2 for the two axes, or 0
    LensGeometry geometry = LensGeometry::perspective;
    bool polynomial = false; ///< whether a LensDistortion follows
};

/// The model with this number, or null if it is not a model of COLMAP (4.2, and two models added
/// since). Cost: O(1).
const LensModel* lens_model(int number);

/// The model with this name, or null.
const LensModel* lens_model(std::string_view name);

/// The distortion of a point m of the image plane at focal length 1, with s = m . m:
///
///     m N(s) / D(s) + s q + 2 (q . m) m + s a + s^2 b
///
/// N = 1 + k1 s + k2 s^2 + ... and the similar D are the radial part, q the tangential part (Brown,
/// 1971), a and b the thin prism part. All coefficients are dimensionless.
struct LensDistortion {
    std::array<double, 6> radial{};  ///< k1, k2, ... in N
    std::array<double, 3> divisor{}; ///< coefficients in D
    /// q, which is (p2, p1) in OpenCV's names.
    Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
    Eigen::Vector2d prism_s = Eigen::Vector2d::Zero();  ///< a
    Eigen::Vector2d prism_ss = Eigen::Vector2d::Zero(); ///< b
    bool divides = false;                               ///< whether D is not 1
    bool in_sequence = false;                           ///< q, a and b act on m N / D, not on m
};

/// Distorts a point. Cost: about 40 multiplications.
Eigen::Vector2d distort(const LensDistortion& lens, const Eigen::Vector2d& point);

/// Whether the distorted radius increases strictly from the center to `point`. A polynomial turns
/// somewhere, often not far outside the image. Beyond the turn it would map points far off the axis
/// back into the image, which no lens does. Only radii are checked, not displacements across the
/// line by q, a and b. Cost: about 40 multiplications well before the turn, 100 more with a
/// divisor, and at most about 10,000 near the turn or beyond.
bool before_turn(const LensDistortion& lens, const Eigen::Vector2d& point);

/// The point before the turn that distort() maps to `target`, by Newton's method. Returns another
/// point if there is none, so check the result with distort(). Cost: about 5 steps, at most 50,
/// each of distort() and before_turn().
Eigen::Vector2d undistort(const LensDistortion& lens, const Eigen::Vector2d& target);

} // namespace vcarve
