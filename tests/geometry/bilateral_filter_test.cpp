#include "geometry/bilateral_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vcarve::bilateral_filter_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kVariance = 1e-4; // of every point: a standard deviation of .01 per pixel

/// A point above the center of four points on a plane. They are its neighbors and have none.
struct Raised {
    std::vector<Vector3d> positions;

    explicit Raised(double height)
        : positions{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, height}}
    {
    }

    BilateralFilter filter(double variance = kVariance) const
    {
        Neighborhoods neighborhoods(5, 4);
        const std::vector<std::uint32_t> around = {0, 1, 2, 3};
        neighborhoods.set(4, around, 1.0);
        return {positions, std::vector<Vector3d>(5, Vector3d::UnitZ()), neighborhoods,
                [=](std::size_t) -> Matrix3d { return variance * Matrix3d::Identity(); }};
    }
};

TEST(LogNearness, FallsWithSquaredDistance)
{
    EXPECT_EQ(log_nearness(0.0, 4.0), 0.0);
    EXPECT_DOUBLE_EQ(log_nearness(4.0, 4.0), -1.125);
    EXPECT_DOUBLE_EQ(log_nearness(1.0, 4.0), -1.125 / 4);
}

TEST(BilateralFilter, ReturnsHeightAndVarianceAbovePlane)
{
    const Raised raised(0.01);
    const Height height = raised.filter().height(4, 2.0);
    EXPECT_DOUBLE_EQ(height.value, 0.01);
    EXPECT_DOUBLE_EQ(height.variance, 2 * kVariance / 4); // both points', mean of 4 planes
}

TEST(BilateralFilter, MovesPointsInProportionToTheirVariance)
{
    const Raised raised(0.01);
    const Vector3d estimate = raised.filter().estimate(4, 2.0);
    EXPECT_NEAR(estimate.z(), 0.01 / 3, 1e-12); // the ratio of variances is 1 to 1 / 2
    EXPECT_EQ(estimate.head<2>(), Eigen::Vector2d(0, 0));
}

TEST(BilateralFilter, LimitsMovesToGate)
{
    const Raised raised(0.05);
    EXPECT_NEAR(raised.filter().estimate(4, 2.0).z(), 0.05 - 0.02, 1e-12);
}

TEST(BilateralFilter, KeepsPointsFarFromAllPlanesOrOfUnknownVariance)
{
    const Raised far(1.0);
    EXPECT_EQ(far.filter().height(4, 2.0).value, 0.0);
    EXPECT_EQ(far.filter().estimate(4, 2.0), far.positions[4]);
    const Raised unknown(0.01);
    EXPECT_EQ(unknown.filter(0.0).estimate(4, 2.0), unknown.positions[4]);
}

TEST(FilteredNormals, AverageSimilarNormals)
{
    const std::vector<Vector3d> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Neighborhoods neighborhoods(3, 2);
    const std::vector<std::uint32_t> around = {1, 2};
    neighborhoods.set(0, around, 1.0);
    const double c = std::cos(0.1);
    const double s = std::sin(0.1);
    const std::vector<Vector3d> normals = {{0, 0, 1}, {s, 0, c}, {0, s, c}};
    const auto filtered = filtered_normals(positions, normals, neighborhoods);
    const double weight = std::exp(-1.125 - (1.0 - c) / (0.35 * 0.35));
    const Vector3d expected(weight * s, weight * s, 1.0 + 2.0 * weight * c);
    EXPECT_LT((filtered[0] - expected.normalized()).norm(), 1e-12);
    EXPECT_LT((filtered[1] - normals[1]).norm(), 1e-15) << "it has no neighbors";
    const std::vector<Vector3d> none(3, Vector3d::Zero());
    EXPECT_EQ(filtered_normals(positions, none, neighborhoods), none);
}

} // namespace
} // namespace vcarve::bilateral_filter_test
