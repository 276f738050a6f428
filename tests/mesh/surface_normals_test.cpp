#include "mesh/surface_normals.h"
#include "steps/5_labels/boundary.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vcarve::surface_normals_test {
namespace {

using Eigen::Vector3d;

/// Three faces around the origin, with the normals z, x and -y. The first two are small, the third
/// has an edge of `reach`. Beside them a face without area.
struct Corner {
    explicit Corner(double reach, const FaceFlags& measured = {})
        : positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-reach, 0, 0}},
          faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 0, 4}},
          edges(positions, faces, measured.empty() ? FaceFlags{1, 1, 1, 0} : measured),
          normals(positions, faces, edges)
    {
    }
    std::vector<Vector3d> positions;
    std::vector<Face> faces;
    LocalEdges edges;
    SurfaceNormals normals;
};

constexpr double kHalf = 0.70710678118654752;

TEST(SurfaceNormals, AreUnitAndPointOutside)
{
    const Corner corner(7.0);
    EXPECT_EQ(corner.normals.of(0), Vector3d(0, 0, 1));
    EXPECT_EQ(corner.normals.of(1), Vector3d(1, 0, 0));
    EXPECT_EQ(corner.normals.of(2), Vector3d(0, -1, 0));
    EXPECT_EQ(corner.normals.of(3), Vector3d(0, 0, 0)) << "no area";
}

TEST(SurfaceNormals, AreTheMeanOfTheSmallFacesAtAVertex)
{
    const Corner corner(7.0);
    EXPECT_TRUE(corner.normals.at(0).isApprox(Vector3d(kHalf, 0, kHalf), 1e-12));
    EXPECT_EQ(corner.normals.at(1), Vector3d(0, 0, 1));
    EXPECT_EQ(corner.normals.at(3), Vector3d(1, 0, 0));
    EXPECT_EQ(corner.normals.at(4), Vector3d(0, 0, 0)) << "no small face";
}

TEST(SurfaceNormals, CountFacesBelowTwoLocalEdges)
{
    // The third face's longest edge is sqrt(1 + reach^2), the median at its middle corner sqrt(2).
    const Corner below(std::sqrt(2 * 1.9 * 1.9 - 1));
    EXPECT_TRUE(below.normals.at(0).isApprox(Vector3d(1, -1, 1).normalized(), 1e-12));
    const Corner above(std::sqrt(2 * 2.1 * 2.1 - 1));
    EXPECT_TRUE(above.normals.at(0).isApprox(Vector3d(kHalf, 0, kHalf), 1e-12));
}

TEST(SurfaceNormals, CountMeasuredFacesOnly)
{
    const Corner corner(7.0, {0, 1, 1, 0});
    EXPECT_EQ(corner.normals.at(0), Vector3d(1, 0, 0));
    EXPECT_EQ(corner.normals.at(1), Vector3d(0, 0, 0));
}

TEST(SurfaceNormals, TellTheAnglesAtAFacesCornersInAscendingOrder)
{
    const Corner corner(7.0);
    const auto first = corner.normals.cosines(0, 0.0);
    EXPECT_NEAR(first[0], kHalf, 1e-12);
    EXPECT_NEAR(first[1], kHalf, 1e-12);
    EXPECT_NEAR(first[2], 1.0, 1e-12);
    EXPECT_EQ(corner.normals.cosines(2, -1.0), (std::array<double, 3>{-1, 0, 0}));
    EXPECT_EQ(corner.normals.cosines(2, 1.0), (std::array<double, 3>{0, 0, 1}));
}

} // namespace
} // namespace vcarve::surface_normals_test
