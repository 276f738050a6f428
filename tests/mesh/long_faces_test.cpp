#include "mesh/long_faces.h"

#include <gtest/gtest.h>

namespace vcarve::long_faces_test {
namespace {

/// Three right triangles with legs of 1, and one with legs of `leg`.
TriMesh triangles(double leg)
{
    TriMesh mesh;
    for (const double length : {1.0, 1.0, 1.0, leg}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {length, 0, 0}, {0, length, 0}});
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(LongArea, IsTheShareOfFacesWithAnEdgeOverSoManyMedians)
{
    // The edges are 1, 1 and 1.41 three times, and 4, 4 and 5.66: their median is 1.41.
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 3.9), 8.0 / 9.5);
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 4.1), 0.0);
    EXPECT_DOUBLE_EQ(long_area(triangles(4.0), 0.5), 1.0);
}

TEST(LongArea, IsNoneOfNoArea)
{
    EXPECT_EQ(long_area(TriMesh(), 2.0), 0.0);
    EXPECT_EQ(long_area(triangles(0.0), 0.0), 1.0);
}

} // namespace
} // namespace vcarve::long_faces_test
