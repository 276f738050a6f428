#include "support/made_cells.h"
#include "support/scenes.h"
#include "surface/face_evidence.h"
#include "surface/freed_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::cell_of;
using testing::labels_where;
using testing::middle;

std::vector<Index> unpaid(const TetMesh& mesh, const Scene& scene, const Labels& before,
                          const Labels& after)
{
    FreedPieces pieces(mesh, scene, before, after);
    pieces.take_away(Boundary(mesh, before));
    pieces.lay_open(Boundary(mesh, after));
    return pieces.unpaid();
}

std::vector<Index> freed(const Labels& before, const Labels& after)
{
    std::vector<Index> cells;
    for (Index cell = 0; cell < before.size(); ++cell) {
        if (before[cell] == Label::inside && after[cell] == Label::outside) cells.push_back(cell);
    }
    return cells;
}

// ---- plausibility -------------------------------------------------------------------------------

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

// ---- FreedPieces --------------------------------------------------------------------------------

/// Two regular tetrahedra on one triangle, all points seen from the views. The upper one is freed.
std::vector<Index> unpaid_of_bipyramid(const std::vector<Vector3d>& centers,
                                       const std::vector<std::uint32_t>& views)
{
    const double height = std::sqrt(2.0 / 3.0);
    const Scene scene = make_scene(centers, {{{1 / std::sqrt(3.0), 0, 0}, views},
                                             {{-0.5 / std::sqrt(3.0), 0.5, 0}, views},
                                             {{-0.5 / std::sqrt(3.0), -0.5, 0}, views},
                                             {{0, 0, -height}, views},
                                             {{0, 0, height}, views}});
    const TetMesh mesh = triangulate(scene);
    Labels after = testing::solid(mesh);
    after[cell_of(mesh, {0, 1, 2, 4})] = Label::outside;
    const auto cells = unpaid(mesh, scene, testing::solid(mesh), after);
    if (!cells.empty()) {
        EXPECT_EQ(cells, freed(testing::solid(mesh), after));
    }
    return cells;
}

TEST(UnpaidCells, AreThoseThatTakeAwayMoreThanTheyLayOpen)
{
    // Three faces go and one as large comes, all small.
    const std::vector<Vector3d> centers = {{0, 0, 50}, {0, 0, -50}};
    EXPECT_EQ(unpaid_of_bipyramid(centers, {}).size(), 1U);
    EXPECT_EQ(unpaid_of_bipyramid(centers, {0}).size(), 1U);
    EXPECT_EQ(unpaid_of_bipyramid(centers, {0, 1}).size(), 1U);
}

TEST(UnpaidCells, AreNotThoseThatTakeAwayWhatWasSeenFromBehind)
{
    EXPECT_TRUE(unpaid_of_bipyramid({{0, 0, -50}}, {0}).empty());
}

/// A plate of small triangles with two tents on it, whose sides slope by about 30 degrees. Views
/// from above saw the plate and the first tent's tip, nobody saw the second's.
TEST(UnpaidCells, AreJudgedPieceByPiece)
{
    std::vector<MadePoint> points;
    for (const Vector3d& p : testing::triangular_lattice(10, 10)) {
        points.push_back({p, {0}});
    }
    const std::array<Index, 3> first = {33, 34, 43};
    const std::array<Index, 3> second = {66, 67, 76};
    for (const auto& [corners, views] : {std::pair(first, std::vector<std::uint32_t>{0}),
                                         std::pair(second, std::vector<std::uint32_t>{})}) {
        Vector3d tip(0, 0, 0.17);
        for (const Index corner : corners) {
            tip += points[corner].position / 3.0;
        }
        points.push_back({tip, views});
    }
    for (const Vector3d& p : mapped(testing::triangular_lattice(2, 2), 5.0, Vector3d(4, 2, -20))) {
        points.push_back({p, {}});
    }
    const Scene scene = make_scene({{7, 4, 60}}, points);
    const TetMesh mesh = triangulate(scene);
    const Labels after =
        labels_where(mesh, [&](Index cell) { return middle(mesh, cell).z() < 0.0; });
    Labels before = after;
    const Index seen = cell_of(mesh, {33, 34, 43, 100});
    const Index unseen = cell_of(mesh, {66, 67, 76, 101});
    before[seen] = Label::inside;
    before[unseen] = Label::inside;
    EXPECT_EQ(unpaid(mesh, scene, before, after), std::vector<Index>{seen});
}

/// A low house with plain walls down to four points on the ground, under a roof of many points that
/// sags a little. Freed is all below the roof; what stays are the cells between points of the roof.
struct House {
    static constexpr Index kRoof = 64;

    explicit House(const std::vector<std::uint32_t>& views_of_roof)
    {
        std::vector<MadePoint> points;
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                const Vector3d place(i - 3.5 + 0.02 * std::sin(5.0 * j), j - 3.5, 2.0);
                const double sag = 0.01 * place.head<2>().squaredNorm();
                points.push_back({place + Vector3d(0, 0, sag), views_of_roof});
            }
        }
        for (const double x : {-3.4, 3.4}) {
            for (const double y : {-3.3, 3.3}) {
                points.push_back({{x, y, 0}, {0, 1, 2, 3, 4, 5}});
            }
        }
        scene = make_scene(
            {{40, 0, 30}, {-40, 0, 30}, {0, 40, 30}, {0, -40, 30}, {0, 0, 60}, {0, 0, 1}}, points);
        mesh = triangulate(scene);
        before = testing::solid(mesh);
        after = labels_where(mesh, [&](Index cell) {
            return std::ranges::all_of(mesh.cells[cell].vertices,
                                       [](Index vertex) { return vertex < kRoof; });
        });
    }
    Scene scene;
    TetMesh mesh;
    Labels before;
    Labels after;
};

TEST(UnpaidCells, AreTheInsideOfAHouseSeenFromAbove)
{
    const House house({0, 1, 2, 3, 4});
    EXPECT_EQ(unpaid(house.mesh, house.scene, house.before, house.after),
              freed(house.before, house.after));
}

TEST(UnpaidCells, AreNotARoomThatAViewInItSaw)
{
    const House house({0, 1, 2, 3, 4, 5});
    EXPECT_TRUE(unpaid(house.mesh, house.scene, house.before, house.after).empty());
}

TEST(UnpaidCells, AreNoneWhereNothingWasFreed)
{
    const House house({0});
    EXPECT_TRUE(unpaid(house.mesh, house.scene, house.after, house.after).empty());
    EXPECT_TRUE(unpaid(house.mesh, house.scene, house.after, house.before).empty());
}

// ---- by the words of the header -----------------------------------------------------------------

double worth_by_words(const TetMesh& mesh, const Scene& scene, const Boundary& boundary,
                      std::size_t face)
{
    const Face& corners = boundary.faces()[face];
    const Vector3d& a = mesh.positions[corners[0]];
    const Vector3d across =
        (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a) / 2.0;
    const double chance = plausibility(boundary, face);
    if (is_seen(scene, corners, across.normalized())) return across.norm() * chance;
    const bool from_back = is_seen(scene, corners, -across.normalized());
    return across.norm() * (from_back ? -0.5 : 0.5 * chance);
}

std::vector<Index> unpaid_by_words(const TetMesh& mesh, const Scene& scene, const Labels& before,
                                   const Labels& after)
{
    const Boundary taken(mesh, before);
    const Boundary opened(mesh, after);
    const std::vector<Index> cells = freed(before, after);
    std::set<Index> left(cells.begin(), cells.end());
    std::vector<Index> result;
    while (!left.empty()) {
        std::vector<Index> piece = {*left.begin()};
        left.erase(left.begin());
        for (std::size_t i = 0; i < piece.size(); ++i) {
            for (const Index neighbor : mesh.cells[piece[i]].neighbors) {
                if (left.erase(neighbor) > 0) piece.push_back(neighbor);
            }
        }
        double gain = 0.0;
        for (std::size_t i = 0; i < taken.facets().size(); ++i) {
            if (std::ranges::count(piece, taken.facets()[i].cell) > 0)
                gain -= 0.9 * worth_by_words(mesh, scene, taken, i);
        }
        for (std::size_t i = 0; i < opened.facets().size(); ++i) {
            if (std::ranges::count(piece, mesh.other_side(opened.facets()[i]).cell) > 0)
                gain += worth_by_words(mesh, scene, opened, i);
        }
        if (gain < 0.0) result.insert(result.end(), piece.begin(), piece.end());
    }
    std::ranges::sort(result);
    return result;
}

TEST(UnpaidCells, AreWhatTheWordsSay)
{
    std::mt19937_64 random(81);
    const Positions centers = {{3, 0, 1}, {-2, 1, 0}, {0, 3, -1}, {1, -3, 0}, {0, 1, 4}};
    std::size_t num_unpaid = 0;
    std::size_t num_freed = 0;
    for (std::uint64_t round = 0; round < 30; ++round) {
        const double share = even(random, 0.1, 0.9);
        const Scene scene = scene_seen_from(centers, random_points(60, round), share, round);
        const TetMesh mesh = triangulate(scene);
        const Labels before = labels_where(mesh, [&](Index) { return pick(random, 10) < 7; });
        const Labels after = labels_where(mesh, [&](Index cell) {
            return before[cell] == Label::inside && pick(random, 10) < 6;
        });
        const auto cells = unpaid(mesh, scene, before, after);
        ASSERT_EQ(cells, unpaid_by_words(mesh, scene, before, after)) << "round " << round;
        ASSERT_EQ(testing::with_threads(1, [&] { return unpaid(mesh, scene, before, after); }),
                  cells);
        num_unpaid += cells.size();
        num_freed += freed(before, after).size();
    }
    EXPECT_GT(num_unpaid, 0U);
    EXPECT_LT(num_unpaid, num_freed);
}

} // namespace
} // namespace vcarve
