#include "steps/2_cells/point_tree.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

TEST(PointTree, ShowsEachForeignPointOnceWhereAllIsWanted)
{
    for (const std::size_t count : {1, 15, 16, 17, 129, 1000, 5000}) {
        const Positions points = random_points(count, 61);
        const PointTree tree(points);
        const PointRun own{count / 3, count / 2};
        std::vector<int> shown(count, 0);
        tree.visit_foreign(
            own, [](const Box&) { return true; }, [&](std::size_t i) { ++shown[i]; });
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(shown[i], own.contains(i) ? 0 : 1) << i << " of " << count;
        }
    }
}

TEST(PointTree, ShowsAllPointsInABoxThatIsAskedFor)
{
    const Positions points = random_points(3000, 62);
    const PointTree tree(points);
    const Box wanted{{0.2, 0.3, 0.4}, {0.5, 0.5, 0.6}};
    const auto is_in = [&](const Vector3d& p) {
        return (p.array() >= wanted.low.array()).all() && (p.array() <= wanted.high.array()).all();
    };
    std::ptrdiff_t shown = 0;
    tree.visit_foreign(
        {0, 0},
        [&](const Box& box) {
            return (box.low.array() <= wanted.high.array()).all() &&
                   (box.high.array() >= wanted.low.array()).all();
        },
        [&](std::size_t i) { shown += is_in(points[i]) ? 1 : 0; });
    EXPECT_EQ(shown, std::ranges::count_if(points, is_in));
    EXPECT_GT(shown, 0);
}

TEST(PointTree, KnowsTheDistanceToTheNearestForeignPoint)
{
    const Positions points = random_points(500, 63);
    const PointTree tree(points);
    const PointRun own{100, 200};
    const Vector3d at(0.4, 0.6, 0.5);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!own.contains(i)) nearest = std::min(nearest, (points[i] - at).norm());
    }
    EXPECT_DOUBLE_EQ(tree.distance_to_foreign({at, at}, own), nearest);
    EXPECT_EQ(tree.distance_to_foreign({at, at}, {0, 500}),
              std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace vcarve
