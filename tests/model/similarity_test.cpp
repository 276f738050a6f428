#include "model/similarity.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>

namespace vcarve::similarity_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix34 matrix(const Matrix3d& linear, const Vector3d& translation = Vector3d::Zero())
{
    Matrix34 both;
    both << linear, translation;
    return both;
}

Matrix3d turn(double angle)
{
    return Eigen::AngleAxisd(angle, Vector3d(1, 2, -2) / 3.0).toRotationMatrix();
}

TEST(Similarity, IsARotationTimesAScale)
{
    const Matrix34 moves = matrix(0.02 * turn(2.0), Vector3d(5e5, 0, -7));
    EXPECT_EQ(fault_of_similarity(moves), "");
    const Similarity to = similarity_of(moves);
    EXPECT_NEAR(to.scale, 0.02, 1e-15);
    EXPECT_EQ(to.linear, moves.leftCols<3>());
    EXPECT_EQ(to.translation, Vector3d(5e5, 0, -7));
}

TEST(Similarity, AcceptsRoundedDigits)
{
    Matrix3d rounded = turn(0.7);
    rounded = (rounded * 1e4).array().round() / 1e4;
    EXPECT_EQ(fault_of_similarity(matrix(rounded)), "");
}

TEST(Similarity, RejectsReflectionsShearAndSingularMatrices)
{
    EXPECT_EQ(fault_of_similarity(matrix(Vector3d(1, 1, -1).asDiagonal() * turn(1.0))),
              "a reflection, which turns surfaces inside out");
    EXPECT_EQ(fault_of_similarity(matrix(Vector3d(1, 1, 1.01).asDiagonal())),
              "a matrix with shear or unequal scales");
    Matrix3d shear = Matrix3d::Identity();
    shear(0, 1) = 0.01;
    EXPECT_EQ(fault_of_similarity(matrix(shear)), "a matrix with shear or unequal scales");
    EXPECT_EQ(fault_of_similarity(matrix(Matrix3d::Zero())), "a singular or infinite matrix");
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(fault_of_similarity(matrix(turn(1.0), Vector3d(0, infinity, 0))),
              "a singular or infinite matrix");
}

TEST(Similarity, AppliesTranslationOnlyToTheOffset)
{
    const Similarity to = similarity_of(matrix(2.0 * Matrix3d::Identity(), Vector3d(1, 0, 0)));
    std::vector<Vector3d> positions = {Vector3d(1, 2, 3), Vector3d::Zero()};
    Vector3d offset(10, 0, 0);
    move_positions(to, positions, offset);
    EXPECT_EQ(positions, (std::vector<Vector3d>{{2, 4, 6}, {0, 0, 0}}));
    EXPECT_EQ(offset, Vector3d(21, 0, 0));
}

} // namespace
} // namespace vcarve::similarity_test
