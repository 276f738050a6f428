#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <string>
#include <vector>

namespace vcarve {

/// A similarity transformation from one frame to another: x maps to linear * x + translation.
struct Similarity {
    double scale = 1.0;
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(); ///< the scale times a rotation
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// Describes a matrix that is not a similarity, as a phrase after "is" or "found"; empty if it is
/// one. To allow for rounded digits, axes may deviate by a thousandth.
inline std::string fault_of_similarity(const Matrix34& matrix)
{
    constexpr double kCutOff = 1e-3;
    const Eigen::Matrix3d linear = matrix.leftCols<3>();
    const double volume = linear.determinant();
    const double scale = std::cbrt(std::abs(volume));
    if (!matrix.allFinite() || !std::isfinite(volume) || !(scale > 0.0)) {
        return "a singular or infinite matrix";
    }
    const Eigen::Matrix3d axes = linear / scale;
    const Eigen::Matrix3d off = axes.transpose() * axes - Eigen::Matrix3d::Identity();
    if (off.cwiseAbs().maxCoeff() > kCutOff) return "a matrix with shear or unequal scales";
    return volume > 0.0 ? "" : "a reflection, which turns surfaces inside out";
}

/// Converts a matrix without changes. Precondition: fault_of_similarity() is empty.
inline Similarity similarity_of(const Matrix34& matrix)
{
    const Eigen::Matrix3d linear = matrix.leftCols<3>();
    return {std::cbrt(linear.determinant()), linear, matrix.col(3)};
}

/// Transforms positions that are relative to `offset`, and the offset. The positions keep their
/// precision even if the offset is large.
inline void move_positions(const Similarity& to, std::vector<Eigen::Vector3d>& positions,
                           Eigen::Vector3d& offset)
{
    for (Eigen::Vector3d& position : positions) {
        position = to.linear * position;
    }
    offset = to.linear * offset + to.translation;
}

} // namespace vcarve
