#include "mesh/local_shape.h"
#include "steps/5_labels/boundary.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vcarve::local_shape_test {
namespace {

using Eigen::Vector3d;

struct Soup {
    std::vector<Vector3d> positions;
    std::vector<Face> faces;
};

/// Faces of random points at scales from 1 to 1000, so that some are much larger than others.
Soup random_soup(std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Soup soup;
    for (int i = 0; i < 60; ++i) { // the last ten have no face
        const double scale = std::pow(10.0, 3.0 * unit(random));
        soup.positions.push_back({scale * unit(random), scale * unit(random), unit(random)});
    }
    while (soup.faces.size() < 150) {
        Face face{};
        std::ranges::generate(face, [&] { return static_cast<std::uint32_t>(random() % 50); });
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
            soup.faces.push_back(face);
        }
    }
    return soup;
}

double side(const Soup& soup, std::size_t face, std::size_t i)
{
    const Face& corners = soup.faces[face];
    return (soup.positions[corners[i]] - soup.positions[corners[(i + 1) % 3]]).norm();
}

double longest(const Soup& soup, std::size_t face)
{
    return std::max({side(soup, face, 0), side(soup, face, 1), side(soup, face, 2)});
}

/// The median as defined in the header.
double median_by_sorting(const Soup& soup, const FaceFlags& measured, std::uint32_t vertex)
{
    std::vector<double> lengths;
    for (std::size_t face = 0; face < soup.faces.size(); ++face) {
        if (measured[face] == 0 || std::ranges::count(soup.faces[face], vertex) == 0) continue;
        lengths.insert(lengths.end(),
                       {side(soup, face, 0), side(soup, face, 1), side(soup, face, 2)});
    }
    std::ranges::sort(lengths);
    return lengths.empty() ? 0.0 : lengths[lengths.size() / 2];
}

TEST(LocalEdges, ReturnMediansOfMeasuredFacesAtEachVertex)
{
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const Soup soup = random_soup(seed);
        FaceFlags measured(soup.faces.size());
        for (std::size_t face = 0; face < measured.size(); ++face) {
            measured[face] = face % 3 != seed % 3 ? 1 : 0;
        }
        const LocalEdges edges(soup.positions, soup.faces, measured);
        for (std::uint32_t v = 0; v < soup.positions.size(); ++v) {
            EXPECT_EQ(edges.median(v), median_by_sorting(soup, measured, v));
            EXPECT_EQ(edges.median(v), edges.median(v)) << "a repeated call";
        }
    }
}

TEST(LocalEdges, CompareFacesWithSecondLargestMedianOfCorners)
{
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const Soup soup = random_soup(seed);
        const FaceFlags all(soup.faces.size(), 1);
        const LocalEdges edges(soup.positions, soup.faces);
        for (std::uint32_t face = 0; face < soup.faces.size(); ++face) {
            std::array<double, 3> scales{};
            std::ranges::transform(soup.faces[face], scales.begin(), [&](std::uint32_t v) {
                return median_by_sorting(soup, all, v);
            });
            std::ranges::sort(scales);
            EXPECT_EQ(edges.relative_size(face), longest(soup, face) / scales[1]);
        }
    }
}

TEST(LocalEdges, ReturnTheMiddleEdgeOfASingleFace)
{
    const Soup soup = {{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {9, 9, 9}}, {{0, 1, 2}}};
    const LocalEdges edges(soup.positions, soup.faces);
    EXPECT_EQ(edges.median(0), 4.0);
    EXPECT_EQ(edges.median(3), 0.0);
    EXPECT_EQ(edges.longest_edge(0), 5.0);
    EXPECT_EQ(edges.relative_size(0), 1.25);
}

/// Three faces around the origin, with the normals z, x and -y. The first two are small, the third
/// has an edge of length `reach`. A fourth face has no area.
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

TEST(SurfaceNormals, AverageSmallFacesAtVertices)
{
    const Corner corner(7.0);
    EXPECT_TRUE(corner.normals.at(0).isApprox(Vector3d(kHalf, 0, kHalf), 1e-12));
    EXPECT_EQ(corner.normals.at(1), Vector3d(0, 0, 1));
    EXPECT_EQ(corner.normals.at(3), Vector3d(1, 0, 0));
    EXPECT_EQ(corner.normals.at(4), Vector3d(0, 0, 0)) << "no small face";
}

TEST(SurfaceNormals, UseFacesBelowTwoLocalEdges)
{
    // The longest edge of the third face is sqrt(1 + reach^2), its second largest median sqrt(2).
    const Corner below(std::sqrt(2 * 1.9 * 1.9 - 1));
    EXPECT_TRUE(below.normals.at(0).isApprox(Vector3d(1, -1, 1).normalized(), 1e-12));
    const Corner above(std::sqrt(2 * 2.1 * 2.1 - 1));
    EXPECT_TRUE(above.normals.at(0).isApprox(Vector3d(kHalf, 0, kHalf), 1e-12));
}

TEST(SurfaceNormals, UseMeasuredFacesOnly)
{
    const Corner corner(7.0, {0, 1, 1, 0});
    EXPECT_EQ(corner.normals.at(0), Vector3d(1, 0, 0));
    EXPECT_EQ(corner.normals.at(1), Vector3d(0, 0, 0));
}

TEST(SurfaceNormals, ReturnCosinesAtCornersInAscendingOrder)
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
} // namespace vcarve::local_shape_test
