#include "geometry/point_order.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace vcarve::point_order_test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> in_order(const std::vector<Vector3d>& places)
{
    std::vector<Vector3d> ordered;
    for (const std::uint32_t place : hilbert_order(places)) {
        ordered.push_back(places[place]);
    }
    return ordered;
}

TEST(HilbertOrder, ContainsEachPositionOnce)
{
    std::vector<std::uint32_t> order = hilbert_order(bumpy_sphere(1000, 3).positions);
    std::ranges::sort(order);
    std::vector<std::uint32_t> all(1000);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
    EXPECT_TRUE(hilbert_order({}).empty());
}

TEST(HilbertOrder, DoesNotDependOnInputOrder)
{
    const Scene scene = bumpy_sphere(2000, 11);
    EXPECT_EQ(in_order(scene.positions), in_order(permuted(scene, 3).positions));
}

TEST(HilbertOrder, PutsNeighborsNextToEachOther)
{
    const std::vector<Vector3d> places = bumpy_sphere(4000, 13).positions;
    const auto way = [](const std::vector<Vector3d>& along) {
        double length = 0.0;
        for (std::size_t i = 1; i < along.size(); ++i) {
            length += (along[i] - along[i - 1]).norm();
        }
        return length;
    };
    EXPECT_LT(way(in_order(places)), 0.2 * way(places));
}

TEST(LexicographicSort, SortsFinitePointsByCoordinatesAndIndex)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(lexicographic_sort({{1, 0, 0},
                                  {0, 1, 0},
                                  {nan, 0, 0},
                                  {0, 0, 5},
                                  {0, 1, 0},
                                  {0, infinity, 0},
                                  {0, 1, -1},
                                  {-2, 9, 9}}),
              (std::vector<std::uint32_t>{7, 3, 6, 1, 4, 0}));
    EXPECT_TRUE(lexicographic_sort({}).empty());
}

} // namespace
} // namespace vcarve::point_order_test
