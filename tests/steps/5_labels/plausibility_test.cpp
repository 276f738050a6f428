#include "steps/5_labels/freed_pieces.h"
#include "support/made_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::cell_of;
using testing::labels_where;
using testing::middle;

/// A solid with two faces of small triangles and a strip of long ones between them: the first at
/// height 0 up to the line x = 0, with normal -z, the second across x, with normal x. The strip
/// leans by `degrees` against the first. The median at its corners is kEdge, its longest edges are
/// `size` times that.
class BentSolid {
  public:
    BentSolid(double degrees, double size)
    {
        const double width = std::sqrt(size * size * kEdge * kEdge - 1.0);
        const double angle = degrees * std::numbers::pi / 180.0;
        start_ = {width * std::cos(angle), 0.0, width * std::sin(angle)};
        Positions points;
        for (int row = 0; row < 4; ++row) {
            for (int i = 0; i <= 8; ++i) {
                const double y = i + (row % 2 == 0 ? 0.0 : 0.5);
                points.emplace_back(-0.875 * row, y, 0.0);
                points.emplace_back(start_.x(), y, start_.z() + 0.875 * row);
            }
        }
        for (const double y : {0.0, 8.5}) {
            points.emplace_back(-2.0, y, start_.z() + 30.0);
            points.emplace_back(start_.x(), y, start_.z() + 30.0);
        }
        mesh_ = triangulation_of(points);
    }

    /// The plausibilities of the strip's faces with so many corners at x = 0, away from its ends.
    std::vector<double> of_strip(std::ptrdiff_t corners_at_first) const
    {
        const Boundary boundary(mesh_, testing::solid(mesh_));
        std::vector<double> found;
        for (std::size_t face = 0; face < boundary.faces().size(); ++face) {
            const auto count = [&](const auto& is) {
                return std::ranges::count_if(boundary.faces()[face],
                                             [&](Index v) { return is(mesh_.positions[v]); });
            };
            const auto at_first = count(
                [&](const Vector3d& p) { return p.x() == 0.0 && p.z() == 0.0 && is_amid(p); });
            const auto at_second = count([&](const Vector3d& p) {
                return p.x() == start_.x() && p.z() == start_.z() && is_amid(p);
            });
            if (at_first == corners_at_first && at_first + at_second == 3) {
                found.push_back(plausibility(boundary, face));
            }
        }
        return found;
    }

  private:
    static constexpr double kEdge = 1.0077822185373186; // sqrt(0.5^2 + 0.875^2)
    static bool is_amid(const Vector3d& p) { return p.y() >= 2.0 && p.y() <= 6.0; }

    Vector3d start_; ///< of the second face
    TetMesh mesh_;
};

/// All four strips of two triangles have this one plausibility.
void expect_strip(double degrees, double size, std::ptrdiff_t corners_at_first, double expected)
{
    const auto found = BentSolid(degrees, size).of_strip(corners_at_first);
    EXPECT_EQ(found.size(), 4U);
    for (const double chance : found) {
        EXPECT_NEAR(chance, expected, 1e-9) << degrees << " degrees, size " << size;
    }
}

TEST(Plausibility, FallsSlowlyWhereAFaceGoesOnAtTwoCorners)
{
    expect_strip(0.0, 12.0, 2, 0.5);  // 1 / (1 + 1)
    expect_strip(0.0, 24.0, 2, 0.2);  // 1 / (1 + 4)
    expect_strip(0.0, 4.0, 2, 0.9);   // 1 / (1 + 1 / 9)
    expect_strip(36.0, 12.0, 2, 0.5); // the cosine is 0.809
    expect_strip(54.0, 12.0, 1, 0.5); // on the other side
}

TEST(Plausibility, FallsAlikeFromLessWhereAFaceGoesOnAtOneCorner)
{
    expect_strip(0.0, 15.0, 1, 0.425); // 0.85 / (1 + 1)
    expect_strip(0.0, 30.0, 1, 0.17);  // 0.85 / (1 + 4)
    expect_strip(36.0, 15.0, 1, 0.425);
    expect_strip(54.0, 15.0, 2, 0.425);
}

TEST(Plausibility, FallsFastWhereAFaceGoesOnAtNoCorner)
{
    for (const std::ptrdiff_t corners : {1, 2}) {
        expect_strip(38.0, 6.0, corners, 0.375); // 0.75 / (1 + 1); the cosine is 0.788
        expect_strip(45.0, 24.0, corners, 0.15); // 0.75 / (1 + 4)
        expect_strip(52.0, 6.0, corners, 0.375);
    }
    // A regular tetrahedron: the mean of the normals around a corner is across from the fourth.
    const TetMesh mesh = triangulation_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}});
    const Boundary boundary(mesh, testing::solid(mesh));
    ASSERT_EQ(boundary.faces().size(), 4U);
    for (std::size_t face = 0; face < 4; ++face) {
        EXPECT_NEAR(plausibility(boundary, face), 9.0 / 14.0, 1e-9); // 0.75 / (1 + 1 / 6)
    }
}

TEST(Plausibility, CountsACornerWithoutSmallFacesAsOneWhereAFaceDoesNotGoOn)
{
    // A spike on a plate: at its tip there are long faces only.
    Positions points = testing::triangular_lattice(10, 10);
    points.push_back((points[44] + points[45] + points[54]) / 3.0 + Vector3d(0, 0, 6));
    for (const Vector3d& p : mapped(testing::triangular_lattice(2, 2), 5.0, Vector3d(4, 2, -20))) {
        points.push_back(p);
    }
    const TetMesh mesh = triangulation_of(points);
    const Index spike = cell_of(mesh, {44, 45, 54, 100});
    const Boundary boundary(mesh, labels_where(mesh, [&](Index cell) {
                                return cell == spike || middle(mesh, cell).z() < 0.0;
                            }));
    int found = 0;
    for (std::size_t face = 0; face < boundary.faces().size(); ++face) {
        if (boundary.facets()[face].cell != spike) continue;
        const double size = boundary.edges().relative_size(face);
        EXPECT_NEAR(size, 6.0, 0.1);
        EXPECT_NEAR(plausibility(boundary, face), 0.75 / (1.0 + size / 6.0), 1e-9);
        ++found;
    }
    EXPECT_EQ(found, 3);
}

} // namespace
} // namespace vcarve
