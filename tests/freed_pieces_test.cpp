#include "support/made_cells.h"
#include "support/scenes.h"
#include "surface/face_evidence.h"
#include "surface/freed_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
    auto cells = unpaid(mesh, scene, testing::solid(mesh), after);
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
