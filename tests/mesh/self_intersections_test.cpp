#include "mesh/self_intersections.h"
#include "support/point_sets.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <random>

namespace vcarve::self_intersections_test {
namespace {

using Eigen::Vector3d;

TriMesh mesh_of(Positions positions, std::vector<Face> faces)
{
    TriMesh mesh;
    mesh.positions = std::move(positions);
    mesh.faces = std::move(faces);
    return mesh;
}

std::int64_t intersections(Positions positions, std::vector<Face> faces)
{
    return count_self_intersections(mesh_of(std::move(positions), std::move(faces)));
}

const Positions kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

} // namespace

TEST(CountSelfIntersections, FindsNothingWhereFacesAreOneAtEdgesAndCorners)
{
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {0, 2, 3}}), 0);
    EXPECT_EQ(intersections({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 3}},
                            {{0, 1, 2}, {0, 3, 4}}),
              0);
}

TEST(CountSelfIntersections, TakesCopiesOfAVertexForOne)
{
    Positions positions = kSquare;
    positions.insert(positions.end(), {{0, 0, 0}, {-1, 0, 0}, {-1, 1, 3}});
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 0) << "at a corner";
    positions = kSquare;
    positions.insert(positions.end(), {{0, 0, 0}, {1, 1, 0}, {0, 0, 5}});
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 0) << "at an edge";
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}), 0);
    positions[6] = {1, 0, 0};
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 1) << "face on face";
    positions[6] = {0.5, -1, 0};
    EXPECT_EQ(intersections(positions, {{0, 1, 2}, {4, 5, 6}}), 1) << "folded back";
}

TEST(CountSelfIntersections, FindsFacesThatGoThroughEachOtherOrTouch)
{
    const auto beside = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        return intersections({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, a, b, c}, {{0, 1, 2}, {3, 4, 5}});
    };
    EXPECT_EQ(beside({0.5, 0.5, -1}, {0.5, 0.5, 1}, {5, 5, 1}), 1) << "through";
    EXPECT_EQ(beside({0.5, 0.5, 0}, {0.5, 0.5, 1}, {5, 5, 1}), 1) << "with a corner";
    EXPECT_EQ(beside({0.5, 0.5, 1e-300}, {0.5, 0.5, 1}, {5, 5, 1}), 0) << "just over it";
    EXPECT_EQ(beside({0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.2, 0.4, 0}), 1) << "within it";
    EXPECT_EQ(beside({1, 0, 0}, {3, 0, 0}, {2, -1, 0}), 1) << "along a piece of an edge";
}

TEST(CountSelfIntersections, FindsFacesThatLieOnOneAnotherOrAreFoldedBack)
{
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {0, 1, 3}}), 1) << "folded back at an edge";
    EXPECT_EQ(intersections(kSquare, {{0, 1, 2}, {2, 1, 0}}), 1) << "twice";
    EXPECT_EQ(intersections({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}},
                            {{0, 1, 2}, {0, 3, 4}}),
              1)
        << "from a corner through the face";
}

TEST(CountSelfIntersections, LeavesOutFacesWithoutArea)
{
    EXPECT_EQ(intersections({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}},
                            {{0, 1, 2}, {0, 1, 3}, {3, 3, 0}}),
              0);
}

TEST(CountSelfIntersections, CountsAsCgalDoesOfFacesWithoutCommonCorners)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::mt19937_64 random(5);
    TriMesh mesh;
    std::vector<Kernel::Triangle_3> triangles;
    for (std::uint32_t f = 0; f < 300; ++f) {
        const Vector3d middle = even_in_cube(random, 0.0, 1.0);
        std::array<Kernel::Point_3, 3> corners;
        for (auto& corner : corners) {
            const Vector3d at = middle + even_in_cube(random, -0.2, 0.2);
            mesh.positions.push_back(at);
            corner = {at.x(), at.y(), at.z()};
        }
        mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
        triangles.emplace_back(corners[0], corners[1], corners[2]);
    }
    std::int64_t expected = 0;
    for (std::size_t a = 0; a < triangles.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            expected += CGAL::do_intersect(triangles[a], triangles[b]) ? 1 : 0;
        }
    }
    EXPECT_GT(expected, 100);
    EXPECT_EQ(count_self_intersections(mesh), expected);
}

} // namespace vcarve::self_intersections_test
