#include "geometry/predicates.h"
#include "geometry/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

Vector3d random_place(std::mt19937_64& engine)
{
    // On a grid, so that segments also meet edges and corners.
    std::uniform_int_distribution<int> coordinate(0, 6);
    const int x = coordinate(engine);
    const int y = coordinate(engine);
    return {static_cast<double>(x), static_cast<double>(y),
            static_cast<double>(coordinate(engine))};
}

TEST(TriangleTree, SaysWhatEachTriangleSays)
{
    std::mt19937_64 engine(7);
    std::vector<Triangle> triangles;
    while (triangles.size() < 12) {
        const Triangle t = {random_place(engine), random_place(engine), random_place(engine)};
        if (!collinear(t[0], t[1], t[2])) triangles.push_back(t);
    }
    const TriangleTree tree(triangles);
    int met = 0;
    int asked = 0;
    while (asked < 2000) {
        const Vector3d from = random_place(engine);
        const Vector3d to = random_place(engine);
        if (from == to) continue;
        ++asked;
        const bool expected = std::ranges::any_of(
            triangles, [&](const Triangle& t) { return meets_triangle(from, to, t); });
        EXPECT_EQ(tree.is_met(from, to), expected);
        met += expected ? 1 : 0;
    }
    EXPECT_GT(met, 500);
    EXPECT_LT(met, 1900);
}

TEST(TriangleTree, ShowsEachTriangleThatIsMetOnce)
{
    std::mt19937_64 engine(8);
    std::vector<Triangle> triangles(40);
    for (Triangle& triangle : triangles) { // some without area
        triangle = {random_place(engine), random_place(engine), random_place(engine)};
    }
    const TriangleTree tree(triangles);
    std::size_t met = 0;
    for (int asked = 0; asked < 500; ++asked) {
        const Vector3d from = random_place(engine);
        const Vector3d to = random_place(engine);
        if (from == to) continue;
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto& [a, b, c] = triangles[i];
            if (!collinear(a, b, c) && meets_triangle(from, to, triangles[i]))
                expected.push_back(i);
        }
        std::vector<std::size_t> shown;
        tree.visit_met(from, to, [&](std::size_t i) { shown.push_back(i); });
        std::ranges::sort(shown);
        EXPECT_EQ(shown, expected);
        met += shown.size();
    }
    EXPECT_GT(met, 500U);
    TriangleTree({}).visit_met({1, 0, 1}, {1, 0, -1}, [](std::size_t) { FAIL(); });
}

TEST(TriangleTree, LeavesOutTrianglesWithoutArea)
{
    const std::vector<Triangle> flat = {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0)}};
    EXPECT_FALSE(TriangleTree(flat).is_met({1, 0, 1}, {1, 0, -1}));
    EXPECT_FALSE(TriangleTree({}).is_met({1, 0, 1}, {1, 0, -1}));
}

} // namespace
} // namespace vcarve
