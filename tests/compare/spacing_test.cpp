#include "base/numbers.h"
#include "compare/spacing.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace vcarve::spacing_test {
namespace {

using ::testing::DoubleEq;
using ::testing::Each;
using ::testing::ElementsAre;

TEST(PointSpacings, AreDistancesToTheSixthNearest)
{
    std::vector<Eigen::Vector3d> line;
    for (int i = 0; i < 10; ++i) {
        line.emplace_back(i, 0, 0);
    }
    EXPECT_THAT(point_spacings(line), ElementsAre(6, 5, 4, 3, 3, 3, 3, 4, 5, 6));
}

TEST(PointSpacings, EqualThoseFoundBySorting)
{
    std::vector<Eigen::Vector3d> points;
    for (std::uint64_t i = 0; i < 300; ++i) {
        points.emplace_back(random_number(1, 3 * i), random_number(1, 3 * i + 1),
                            0.1 * random_number(1, 3 * i + 2));
    }
    const std::vector<double> spacings = point_spacings(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<double> distances;
        for (const Eigen::Vector3d& other : points) {
            distances.push_back((other - points[i]).norm());
        }
        std::ranges::sort(distances);
        EXPECT_DOUBLE_EQ(spacings[i], distances[6]);
    }
}

TEST(PointSpacings, TakeTheFarthestOfFewPoints)
{
    const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {3, 4, 0}};
    EXPECT_THAT(point_spacings(points), ElementsAre(5, 5));
}

TEST(PointSpacings, AreNeverLessThanAHundredthOfTheMedian)
{
    std::vector<Eigen::Vector3d> points(50, Eigen::Vector3d(-9, 0, 0));
    for (int i = 0; i < 60; ++i) {
        points.emplace_back(i, 0, 0);
    }
    const std::vector<double> spacings = point_spacings(points);
    EXPECT_THAT(std::vector<double>(spacings.begin(), spacings.begin() + 50), Each(DoubleEq(0.03)));
}

TEST(PointSpacings, AreZeroWhereAllPointsCoincide)
{
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    EXPECT_THAT(point_spacings(points), Each(0.0));
}

} // namespace
} // namespace vcarve::spacing_test
