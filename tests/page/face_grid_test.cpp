#include "page/face_grid.h"
#include "support/measured_scenes.h"

#include <gmock/gmock.h>

namespace vcarve::face_grid_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TriMesh triangle()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 8, 0}};
    mesh.faces = {{0, 1, 2}};
    return mesh;
}

TEST(EdgeParts, AreSoManyThatNoPartIsTooLong)
{
    // The longest edges are 1 and the square root of 2 long.
    const TriMesh square = testing::square();
    EXPECT_THAT(edge_parts(square, 1.5, 1000), ElementsAre(1, 1));
    EXPECT_THAT(edge_parts(square, 1.0, 1000), ElementsAre(2, 2));
    EXPECT_THAT(edge_parts(square, 0.5, 1000), ElementsAre(4, 4));
    EXPECT_THAT(edge_parts(testing::together(square, testing::scaled(square, 0.25)), 0.5, 1000),
                ElementsAre(4, 4, 1, 1));
}

TEST(EdgeParts, AreFewerWhereThereWouldBeTooManyFaces)
{
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 32), ElementsAre(4, 4));
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 31), ElementsAre(2, 2));
    EXPECT_THAT(edge_parts(testing::square(), 0.5, 1), ElementsAre(1, 1));
}

TEST(EdgeParts, AreAtMost64)
{
    EXPECT_THAT(edge_parts(testing::square(), 1e-3, 1'000'000), Each(64));
}

TEST(GridPlaces, LieBetweenTheCornersRowByRow)
{
    const std::vector<std::int32_t> two = {2};
    EXPECT_THAT(
        grid_places(triangle(), two),
        ElementsAre(Eigen::Vector3d(0, 4, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 4, 0)));
    const std::vector<std::int32_t> four = {4};
    EXPECT_THAT(
        grid_places(triangle(), four),
        ElementsAre(Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 4, 0), Eigen::Vector3d(0, 6, 0),
                    Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(1, 4, 0),
                    Eigen::Vector3d(1, 6, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 2, 0),
                    Eigen::Vector3d(2, 4, 0), Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(3, 2, 0)));
}

TEST(GridPlaces, AreNoneOfFacesThatAreNotCut)
{
    const std::vector<std::int32_t> one = {1};
    EXPECT_THAT(grid_places(triangle(), one), IsEmpty());
}

} // namespace
} // namespace vcarve::face_grid_test
