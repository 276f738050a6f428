#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <string>
#include <vector>

namespace vcarve {

/// A rotation, a scale and a shift from one frame to another: x becomes linear * x + translation.
struct Similarity {
    double scale = 1.0;
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(); ///< the scale times a rotation
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// What a matrix is that is no similarity, to be read after "is"; empty where it is one. Digits
/// that were cut off are forgiven: the axes may be a thousandth off.
inline std::string fault_of_similarity(const Matrix34& matrix)
{
    constexpr double kCutOff = 1e-3;
    const Eigen::Matrix3d linear = matrix.leftCols<3>();
    const double volume = linear.determinant();
    const double scale = std::cbrt(std::abs(volume));
    if (!matrix.allFinite() || !std::isfinite(volume) || !(scale > 0.0)) {
        return "no matrix that could be inverted";
    }
    const Eigen::Matrix3d axes = linear / scale;
    const Eigen::Matrix3d off = axes.transpose() * axes - Eigen::Matrix3d::Identity();
    if (off.cwiseAbs().maxCoeff() > kCutOff) return "no rotation times a scale";
    return volume > 0.0 ? "" : "a reflection, which turns surfaces inside out";
}

/// The matrix as it stands, which must be one.
inline Similarity similarity_of(const Matrix34& matrix)
{
    const Eigen::Matrix3d linear = matrix.leftCols<3>();
    return {std::cbrt(linear.determinant()), linear, matrix.col(3)};
}

/// Moves positions that stand in a frame minus `offset`; those stay as exact as they were however
/// far the others lie.
inline void move_positions(const Similarity& to, std::vector<Eigen::Vector3d>& positions,
                           Eigen::Vector3d& offset)
{
    for (Eigen::Vector3d& position : positions) {
        position = to.linear * position;
    }
    offset = to.linear * offset + to.translation;
}

} // namespace vcarve
