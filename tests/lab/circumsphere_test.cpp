#include "baselines/circumsphere.h"
#include "steps/3_cells/triangulate.h"
#include "support/random_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vcarve::circumsphere_test {
namespace {

TetMesh one_cell(const Eigen::Vector3d& fourth)
{
    TetMesh cells;
    cells.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, fourth};
    cells.cells = {{.vertices = {0, 1, 2, 3}, .neighbors = {1, 1, 1, 1}},
                   {.vertices = {0, 1, 2, kInfinite}, .neighbors = {0, 0, 0, 0}}};
    return cells;
}

TEST(Circumsphere, OfACornerHasItsCenterInTheMiddleOfTheCube)
{
    const Circumsphere sphere = circumsphere(one_cell({0, 0, 2}), 0);
    EXPECT_TRUE(sphere.center.isApprox(Eigen::Vector3d(1, 1, 1)));
    EXPECT_DOUBLE_EQ(sphere.radius, std::sqrt(3.0));
}

TEST(Circumsphere, OfFlatAndInfiniteCellsIsInfinite)
{
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(circumsphere(one_cell({5, 3, 0}), 0).radius, infinity);
    EXPECT_EQ(circumsphere(one_cell({0, 0, 2}), 1).radius, infinity);
}

TEST(Circumsphere, PassesThroughTheCornersAndHoldsNoOtherPoint)
{
    const TetMesh cells = triangulate(testing::random_points(60, 1));
    for (Index cell = 0; cell < cells.cells.size(); ++cell) {
        if (cells.cells[cell].is_infinite()) continue;
        const Circumsphere sphere = circumsphere(cells, cell);
        const double tolerance = 1e-7 * sphere.radius;
        for (const Index corner : cells.cells[cell].vertices) {
            const double distance = (cells.positions[corner] - sphere.center).norm();
            EXPECT_NEAR(distance, sphere.radius, tolerance);
        }
        for (const Eigen::Vector3d& position : cells.positions) {
            EXPECT_GE((position - sphere.center).norm(), sphere.radius - tolerance);
        }
    }
}

} // namespace
} // namespace vcarve::circumsphere_test
