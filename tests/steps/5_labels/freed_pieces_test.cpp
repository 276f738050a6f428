#include "steps/4_visibility/face_evidence.h"
#include "steps/5_labels/freed_pieces.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

/// The same scene where every view looks at a place and shows all that lies before it.
Scene looking_at(const Vector3d& place, Scene scene)
{
    scene.cameras[0] = {.id = 1, .model = -1, .width_px = 0, .height_px = 0, .params = {}};
    for (View& view : scene.views) {
        testing::aim(view, place);
    }
    return scene;
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
    const Scene scene =
        looking_at({0, 0, 0}, make_scene(centers, {{{1 / std::sqrt(3.0), 0, 0}, views},
                                                   {{-0.5 / std::sqrt(3.0), 0.5, 0}, views},
                                                   {{-0.5 / std::sqrt(3.0), -0.5, 0}, views},
                                                   {{0, 0, -height}, views},
                                                   {{0, 0, height}, views}}));
    const TetMesh mesh = triangulate(scene);
    Labels after = testing::solid(mesh);
    after[cell_of(mesh, {0, 1, 2, 4})] = Label::outside;
    auto cells = unpaid(mesh, scene, testing::solid(mesh), after);
    if (!cells.empty()) {
        EXPECT_EQ(cells, freed(testing::solid(mesh), after));
    }
    return cells;
}

TEST(UnpaidCells, AreThoseThatLeaveAPointOnNoFace)
{
    const std::vector<Vector3d> centers = {{0, 0, 50}, {0, 0, -50}};
    EXPECT_EQ(unpaid_of_bipyramid(centers, {}).size(), 1U);
    EXPECT_EQ(unpaid_of_bipyramid(centers, {0}).size(), 1U);
    EXPECT_EQ(unpaid_of_bipyramid(centers, {0, 1}).size(), 1U);
}

/// A low house with plain walls down to four points on the ground, under a roof of many points that
/// sags a little. Freed is all below the roof and above the ground.
struct House {
    static constexpr Index kRoof = 64;

    House()
    {
        std::vector<MadePoint> points;
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                const Vector3d place(i - 3.5 + 0.02 * std::sin(5.0 * j), j - 3.5, 2.0);
                const double sag = 0.01 * place.head<2>().squaredNorm();
                points.push_back({place + Vector3d(0, 0, sag), {0, 1, 2, 3, 4}});
            }
        }
        for (const double x : {-3.4, 3.4}) {
            for (const double y : {-3.3, 3.3}) {
                points.push_back({{x, y, 0}, {0, 1, 2, 3, 4}});
                points.push_back({{x, y, -3}, {}});
            }
        }
        scene = looking_at(
            {0, 0, 1.5},
            make_scene({{40, 0, 30}, {-40, 0, 30}, {0, 40, 30}, {0, -40, 30}, {0, 0, 60}}, points));
        mesh = triangulate(scene);
        before = testing::solid(mesh);
        after = labels_where(mesh, [&](Index cell) {
            const auto& corners = mesh.cells[cell].vertices;
            const auto is_low = [&](Index corner) { return mesh.positions[corner].z() <= 0.0; };
            return std::ranges::all_of(corners, [](Index corner) { return corner < kRoof; }) ||
                   std::ranges::all_of(corners, is_low);
        });
    }
    Scene scene;
    TetMesh mesh;
    Labels before;
    Labels after;
};

TEST(UnpaidCells, AreTheInsideOfAHouseSeenFromAbove)
{
    const House house;
    EXPECT_EQ(unpaid(house.mesh, house.scene, house.before, house.after),
              freed(house.before, house.after));
}

/// A floor of many points at the bottom of a pit, four points at its rim. Freed is what lies
/// between the floor, the slopes up to the rim, and the lid.
TEST(UnpaidCells, AreNotAPitUnderALid)
{
    std::vector<MadePoint> points;
    for (const Vector3d& p : testing::triangular_lattice(6, 6)) {
        points.push_back({p - Vector3d(3.75, 2.5, 0), {0, 1}});
    }
    for (const double side : {-8.0, 8.0}) {
        points.push_back({{side, 8.1, 2.5}, {0, 1}});
        points.push_back({{side, -8.2, 2.4}, {0, 1}});
        points.push_back({{side, side, -9}, {}});
        points.push_back({{side, -side, -9}, {}});
    }
    const Scene scene = looking_at({0, 0, 0}, make_scene({{1, 2, 50}, {-1, 3, 40}}, points));
    const TetMesh mesh = triangulate(scene);
    const Labels after =
        labels_where(mesh, [&](Index cell) { return middle(mesh, cell).z() < 0.3; });
    ASSERT_FALSE(freed(testing::solid(mesh), after).empty());
    EXPECT_TRUE(unpaid(mesh, scene, testing::solid(mesh), after).empty());
}

TEST(UnpaidCells, AreNoneWhereNothingWasFreed)
{
    const House house;
    EXPECT_TRUE(unpaid(house.mesh, house.scene, house.after, house.after).empty());
    EXPECT_TRUE(unpaid(house.mesh, house.scene, house.after, house.before).empty());
}

// ---- by the words of the header -----------------------------------------------------------------

/// The first face of a boundary that a ray meets beyond its start, by trying all of them, and
/// whether it meets the face's front.
struct Met {
    std::size_t face = 0;
    double along = std::numeric_limits<double>::infinity();
    bool front = false;
};

Met first_met(const TetMesh& mesh, const Boundary& boundary, const Vector3d& from,
              const Vector3d& way)
{
    Met met;
    for (std::size_t face = 0; face < boundary.faces().size(); ++face) {
        const auto& [i, j, k] = boundary.faces()[face];
        Eigen::Matrix3d sides; // from + along * way = a + u * ab + v * ac
        sides << mesh.positions[j] - mesh.positions[i], mesh.positions[k] - mesh.positions[i], -way;
        const Vector3d uvt = sides.partialPivLu().solve(from - mesh.positions[i]);
        if (!(uvt.x() >= 0.0 && uvt.y() >= 0.0 && uvt.x() + uvt.y() <= 1.0)) continue;
        if (uvt.z() < 1e-9 || uvt.z() > met.along) continue;
        met = {face, uvt.z(), boundary.normals().of(face).dot(way) < 0.0};
    }
    return met;
}

double worth_by_words(const TetMesh& mesh, const Scene& scene, const Boundary& boundary,
                      const Vector3d& from, const Vector3d& way)
{
    const Met met = first_met(mesh, boundary, from, way);
    if (met.along == std::numeric_limits<double>::infinity()) return 0.3;
    if (!met.front) return -0.5;
    const Vector3d normal = boundary.normals().of(met.face);
    const double chance = plausibility(boundary, met.face);
    if (is_seen(scene, boundary.faces()[met.face], normal)) return chance;
    return is_seen(scene, boundary.faces()[met.face], -normal) ? -0.5 : 0.5 * chance;
}

/// What a piece gains for a face it takes away.
double gain_by_words(const TetMesh& mesh, const Scene& scene, const FaceVisibility& visibility,
                     const Boundary& taken, const Boundary& opened, std::size_t face)
{
    const CellFacet& facet = taken.facets()[face];
    const Face& corners = taken.faces()[face];
    std::set<std::uint32_t> views;
    for (const std::uint32_t corner : corners) {
        views.insert(scene.tracks[corner].begin(), scene.tracks[corner].end());
    }
    std::vector<double> worths;
    for (const std::uint32_t view : views) {
        for (int i = 0; i < 4; ++i) {
            const Vector3d place = visibility.places_on(facet)[static_cast<std::size_t>(i)];
            if (!visibility.sees(view, facet, place)) continue;
            const Vector3d way = place - scene.views[view].center;
            worths.push_back(worth_by_words(mesh, scene, opened, place, way));
        }
    }
    if (worths.empty()) return 0.0;
    const Vector3d& a = mesh.positions[corners[0]];
    const double area =
        (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a).norm() / 2.0;
    const double mean =
        std::accumulate(worths.begin(), worths.end(), 0.0) / static_cast<double>(worths.size());
    return area * (mean - 0.9 * plausibility(taken, face));
}

std::vector<Index> unpaid_by_words(const TetMesh& mesh, const Scene& scene, const Labels& before,
                                   const Labels& after)
{
    const Boundary taken(mesh, before);
    const Boundary opened(mesh, after);
    const FaceVisibility visibility(mesh, before, scene);
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
                gain += gain_by_words(mesh, scene, visibility, taken, opened, i);
        }
        for (const Index cell : piece) {
            for (const Index corner : mesh.cells[cell].vertices) {
                const auto has = [&](const Face& face) {
                    return std::ranges::count(face, corner) > 0;
                };
                if (std::ranges::none_of(opened.faces(), has)) gain = -1e300;
            }
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
        const Scene scene =
            looking_at({0, 0, 0}, scene_seen_from(centers, random_points(60, round), share, round));
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
