#include "steps/3_cells/triangulate.h"
#include "steps/5_labels/bridging_facets.h"
#include "steps/5_labels/freed_pieces.h"
#include "support/point_sets.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace vcarve {
namespace {

using Eigen::Vector3d;

constexpr int kSide = 8;
constexpr Index kTip = kSide * kSide; ///< the point that stands high above the plate

/// A plate of points a unit apart with one point high above it, all seen from around and above,
/// and points far below that nobody sees.
Scene plate_and_tip()
{
    const std::vector<Vector3d> centers = {
        {40, 0, 30}, {-40, 3, 30}, {2, 40, 30}, {0, -40, 30}, {1, 1, 60}};
    const std::vector<std::uint32_t> all = {0, 1, 2, 3, 4};
    std::vector<MadePoint> points;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const double unevenness = 0.02 * std::sin(7.0 * i + 3.0 * j * j);
            points.push_back({{i - 3.5 + unevenness, j - 3.5 - unevenness, unevenness}, all});
        }
    }
    points.push_back({{0.1, 0.2, 6.0}, all});
    for (const double x : {-9.0, 9.1}) {
        for (const double y : {-9.2, 9.3}) {
            points.push_back({{x, y, -6.0}, {}});
        }
    }
    return make_scene(centers, points);
}

Vector3d middle(const TetMesh& mesh, const Cell& cell)
{
    Vector3d sum = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        sum += mesh.positions[vertex];
    }
    return sum / 4.0;
}

/// Everything below the plate is inside but for what reaches up to the tip.
Labels below_the_plate(const TetMesh& mesh)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Cell& cell = mesh.cells[i];
        const bool has_tip = std::ranges::count(cell.vertices, kTip) > 0;
        if (!cell.is_infinite() && !has_tip && middle(mesh, cell).z() < 0.0) {
            labels[i] = Label::inside;
        }
    }
    return labels;
}

/// A cell of the tip and three points in the middle of the plate.
Index tall_cell(const TetMesh& mesh)
{
    for (Index i = 0; i < mesh.cells.size(); ++i) {
        const auto& vertices = mesh.cells[i].vertices;
        const bool on_plate = std::all_of(vertices.begin(), vertices.end(), [&](Index vertex) {
            return vertex == kTip ||
                   (vertex < kTip && mesh.positions[vertex].head<2>().norm() < 2.0);
        });
        if (on_plate && std::count(vertices.begin(), vertices.end(), kTip) == 1) {
            return i;
        }
    }
    return kInfinite;
}

TEST(BridgingFacets, AreNotSeenInASurfaceThatRunsOn)
{
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    EXPECT_TRUE(
        cells_behind_bridging_facets(mesh, {mesh, below_the_plate(mesh)}, scene, {}).empty());
}

TEST(BridgingFacets, AreLongSeenFacesAcrossTheSurface)
{
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    const Index tall = tall_cell(mesh);
    ASSERT_NE(tall, kInfinite);
    Labels labels = below_the_plate(mesh);
    labels[tall] = Label::inside;

    const auto doubted = cells_behind_bridging_facets(mesh, {mesh, labels}, scene, {});
    EXPECT_EQ(std::set<Index>(doubted.begin(), doubted.end()), std::set<Index>{tall});
    EXPECT_LE(doubted.size(), 3U) << "once for each of its faces that stand on the plate";
    EXPECT_TRUE(
        cells_behind_bridging_facets(mesh, {mesh, labels}, scene, {.bridging_edge = 0.0}).empty());
    EXPECT_TRUE(
        cells_behind_bridging_facets(mesh, {mesh, labels}, scene, {.bridging_edge = 50.0}).empty());
}

TEST(BridgingFacets, AreOnlyWhatWasSeen)
{
    Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    Labels labels = below_the_plate(mesh);
    labels[tall_cell(mesh)] = Label::inside;
    std::fill(scene.tracks.begins.begin() + kTip + 1, scene.tracks.begins.end(),
              scene.tracks.begins[kTip]); // nobody saw the tip
    scene.tracks.views.resize(scene.tracks.begins[kTip]);
    EXPECT_TRUE(cells_behind_bridging_facets(mesh, {mesh, labels}, scene, {}).empty());
}

/// How far a wall stands behind the edge of the floor, and how far above.
struct Gap {
    double back;
    double up;
    Vector3d slope() const { return Vector3d(up, 0.0, back).normalized(); }
};

/// A floor with x > 0 and a wall beyond its edge, both of points a unit apart and seen from before
/// them. Points far behind that nobody saw.
Scene floor_and_wall(const Gap& gap)
{
    const std::vector<Vector3d> centers = {{30, 4, 20}, {20, -20, 25}, {20, 30, 25}, {40, 5, 40}};
    const std::vector<std::uint32_t> all = {0, 1, 2, 3};
    std::vector<MadePoint> points;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const double uneven = 0.02 * std::sin(7.0 * i + 3.0 * j * j);
            points.push_back({{i + uneven, j - uneven, 0.0}, all});
            points.push_back({{-gap.back, j + 0.5 + uneven, gap.up + i + uneven}, all});
        }
    }
    for (const double y : {-5.0, 4.0, 13.1}) {
        points.push_back({{-8.0, y, 8.0}, {}});
        points.push_back({{20.0, y, -20.3}, {}});
    }
    return make_scene(centers, points);
}

/// Below the floor, behind the wall, and below the slope between their edges.
Labels behind_floor_and_wall(const TetMesh& mesh, const Gap& gap)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (mesh.cells[i].is_infinite()) continue;
        const Vector3d p = middle(mesh, mesh.cells[i]);
        const bool is_inside = p.z() < 0.0 || p.x() < -gap.back || p.dot(gap.slope()) < 0.0;
        if (is_inside) labels[i] = Label::inside;
    }
    return labels;
}

/// Faces of the slope, by how many corners they have on the floor: 1 or 2, then others' on the
/// wall.
struct SlopeFaces {
    std::array<int, 3> all{};
    std::array<int, 3> doubted{};
};

SlopeFaces slope_faces(const Gap& gap)
{
    const Scene scene = floor_and_wall(gap);
    const TetMesh mesh = triangulate(scene);
    const Boundary boundary(mesh, behind_floor_and_wall(mesh, gap));
    const auto doubted =
        cells_behind_bridging_facets(mesh, boundary, scene, {.bridging_edge = 2.5});
    SlopeFaces faces;
    for (std::size_t i = 0; i < boundary.faces().size(); ++i) {
        const Face& corners = boundary.faces()[i];
        // Where floor and wall begin there are other long faces around.
        const bool is_at_end = mesh.positions[corners[0]].y() < 1.4;
        if (is_at_end || boundary.normals().of(i).dot(gap.slope()) < 0.998) continue;
        const auto on_floor = std::ranges::count_if(
            corners, [&](Index corner) { return mesh.positions[corner].z() == 0.0; });
        ++faces.all.at(static_cast<std::size_t>(on_floor));
        faces.doubted.at(static_cast<std::size_t>(on_floor)) +=
            std::ranges::count(doubted, boundary.facets()[i].cell) > 0 ? 1 : 0;
    }
    return faces;
}

TEST(BridgingFacets, StandAcrossAtTwoCornersNotAtOne)
{
    // 76 degrees off the floor and 14 off the wall.
    const SlopeFaces faces = slope_faces({.back = 1.0, .up = 4.0});
    EXPECT_EQ(faces.all, (std::array<int, 3>{0, 6, 5}));
    EXPECT_EQ(faces.doubted, (std::array<int, 3>{0, 0, 5}));
}

TEST(BridgingFacets, DoNotStandAcrossASurfaceThatBendsALittle)
{
    // 27 degrees off the floor and 63 off the wall.
    const SlopeFaces faces = slope_faces({.back = 4.0, .up = 2.0});
    EXPECT_EQ(faces.all, (std::array<int, 3>{0, 5, 5}));
    EXPECT_EQ(faces.doubted[2], 0) << "across the wall at one corner";
}

// ---- doubt_bridging_facets ----------------------------------------------------------------------

constexpr std::int32_t kOneSight = 10;

/// Cells without arcs between them: inside are those with a sink capacity, until they are given as
/// much source capacity.
FlowNetwork wishes(const TetMesh& mesh, const Labels& inside, const Labels& loose)
{
    FlowNetwork network;
    network.arc_capacities.assign(mesh.cells.size(), {0, 0, 0, 0});
    network.terminal_capacities.assign(mesh.cells.size(), 0);
    for (std::size_t cell = 0; cell < inside.size(); ++cell) {
        if (inside[cell] == Label::inside) network.terminal_capacities[cell] = -1000 * kOneSight;
        if (loose[cell] == Label::inside) network.terminal_capacities[cell] = -kOneSight;
    }
    return network;
}

TEST(DoubtBridgingFacets, TakesBackWhatDoesNotPay)
{
    // The tip would be on no face.
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    Labels loose(mesh.cells.size(), Label::outside);
    loose[tall_cell(mesh)] = Label::inside;
    Labels before = below_the_plate(mesh);
    before[tall_cell(mesh)] = Label::inside;
    const auto doubted = cells_behind_bridging_facets(mesh, {mesh, before}, scene, {});

    MinimumCut cut(mesh, wishes(mesh, before, loose));
    const DoubtedLabels result = doubt_bridging_facets(mesh, scene, cut, {{}, kOneSight});
    EXPECT_EQ(result.labelling.labels(), before);
    EXPECT_GT(result.taken_back, 0);
    EXPECT_EQ(result.doubts, static_cast<std::int64_t>(doubted.size()) * result.taken_back)
        << "each time again";
    EXPECT_NE(cut.labels(), before) << "the cut would free it";
}

constexpr int kRows = 6;

/// A valley of many points between two slopes of 60 degrees, 1 wide at the ground and a unit wider
/// with each row, seen from above. Four points far below that nobody saw.
Scene valley()
{
    const std::vector<Vector3d> centers = {{0, 6, 60}, {1, -30, 50}, {-1, 45, 50}};
    std::vector<MadePoint> points;
    const auto add_line = [&](double x, double z, double shift) {
        for (int i = 0; i < 12; ++i) {
            points.push_back({{x, i + shift, z}, {0, 1, 2}});
        }
    };
    for (int row = 0; row <= kRows; ++row) {
        const double shift = row % 2 == 0 ? 0.0 : 0.5;
        add_line(-0.5 - 0.5 * row, 0.875 * row, shift);
        add_line(0.5 + 0.5 * row, 0.875 * row, shift + 0.01);
    }
    for (int beside = 1; beside <= 3; ++beside) {
        add_line(-0.5 - 0.5 * kRows - beside, 0.875 * kRows, 0.25 * beside);
        add_line(0.5 + 0.5 * kRows + beside, 0.875 * kRows, 0.25 * beside + 0.01);
    }
    for (const double x : {-3.0, 3.1}) {
        for (const double y : {2.0, 9.1}) {
            points.push_back({{x, y, -9.0}, {}});
        }
    }
    return make_scene(centers, points);
}

/// The cells between the slopes of the valley up to a row.
Labels in_the_valley(const TetMesh& mesh, int rows)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (mesh.cells[i].is_infinite()) continue;
        const Vector3d p = middle(mesh, mesh.cells[i]);
        if (p.z() > 0.0 && p.z() < 0.875 * rows && std::abs(p.x()) < 0.5 + p.z() / 1.75)
            labels[i] = Label::inside;
    }
    return labels;
}

TEST(DoubtBridgingFacets, FreesWhatPaysOneBehindTheOther)
{
    constexpr int kFilled = 3;
    const Scene scene = valley();
    const TetMesh mesh = triangulate(scene);
    const Labels loose = in_the_valley(mesh, kFilled);
    const Labels above = in_the_valley(mesh, kRows);
    Labels before(mesh.cells.size(), Label::outside);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool is_solid = !mesh.cells[i].is_infinite() && above[i] == Label::outside;
        if (is_solid || loose[i] == Label::inside) before[i] = Label::inside;
    }
    MinimumCut cut(mesh, wishes(mesh, before, loose));
    ASSERT_EQ(cut.labels(), before);
    const DoubtedLabels result = doubt_bridging_facets(mesh, scene, cut, {{}, kOneSight});
    EXPECT_EQ(result.taken_back, 0);
    EXPECT_GT(result.doubts, 0);
    EXPECT_TRUE(
        cells_behind_bridging_facets(mesh, {mesh, result.labelling.labels()}, scene, {}).empty());
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool stays = loose[i] == Label::outside || middle(mesh, mesh.cells[i]).z() < 1.75;
        EXPECT_TRUE(!stays || result.labelling.labels()[i] == before[i]) << "cell " << i;
    }
    EXPECT_EQ(result.labelling.labels(), cut.labels());
}

/// The same with each boundary extracted anew and looked all over.
DoubtedLabels doubted_by_words(const TetMesh& mesh, const Scene& scene, MinimumCut& cut,
                               const BridgingOptions& options)
{
    DoubtedLabels result{.labelling = {mesh, cut.labels()}};
    for (int round = 0; round < 3; ++round) {
        const Labels before = result.labelling.labels();
        const Boundary boundary(mesh, before);
        const auto doubted = cells_behind_bridging_facets(mesh, boundary, scene, options);
        cut.add_source_capacity(doubted, kOneSight);
        Labels labels = cut.labels();
        FreedPieces pieces(mesh, scene, before, labels);
        pieces.take_away(boundary);
        pieces.lay_open({mesh, labels});
        const auto unpaid = pieces.unpaid();
        for (const Index cell : unpaid) {
            labels[cell] = Label::inside;
        }
        result.labelling = {mesh, std::move(labels)};
        result.doubts += static_cast<std::int64_t>(doubted.size());
        result.taken_back += static_cast<std::int64_t>(unpaid.size());
    }
    return result;
}

TEST(DoubtBridgingFacets, FindsAgainAllThatIsThereAfterChanges)
{
    std::int64_t stayed_free = 0;
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        const Scene scene = bumpy_sphere(1200, 40 + seed);
        const TetMesh mesh = triangulate(scene);
        std::mt19937_64 random(seed);
        FlowNetwork network;
        network.arc_capacities.assign(mesh.cells.size(), {1, 1, 1, 1});
        for (const Cell& cell : mesh.cells) {
            const bool is_solid = !cell.is_infinite() && middle(mesh, cell).norm() < 1.0;
            const auto capacity = static_cast<std::int32_t>(pick(random, 30));
            network.terminal_capacities.push_back(is_solid ? -capacity : capacity / 3);
        }
        const BridgingOptions options = {.bridging_edge = 1.5};
        MinimumCut cut(mesh, network);
        MinimumCut same(mesh, network);
        const std::int64_t inside = Labelling(mesh, cut.labels()).num_inside();
        const DoubtedLabels result = doubt_bridging_facets(mesh, scene, cut, {options, kOneSight});
        const DoubtedLabels expected = doubted_by_words(mesh, scene, same, options);
        EXPECT_EQ(result.labelling.labels(), expected.labelling.labels());
        EXPECT_EQ(result.doubts, expected.doubts);
        EXPECT_EQ(result.taken_back, expected.taken_back);
        EXPECT_GT(result.taken_back, 0);
        stayed_free += inside - result.labelling.num_inside();
    }
    EXPECT_GT(stayed_free, 100);
}

TEST(DoubtBridgingFacets, LeavesTheCutAsItIsWhereNotAsked)
{
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    Labels before = below_the_plate(mesh);
    before[tall_cell(mesh)] = Label::inside;
    MinimumCut cut(mesh, wishes(mesh, before, before));
    const DoubtedLabels result =
        doubt_bridging_facets(mesh, scene, cut, {{.bridging_edge = 0.0}, kOneSight});
    EXPECT_EQ(result.labelling.labels(), before);
    EXPECT_EQ(result.doubts, 0);
    EXPECT_EQ(result.taken_back, 0);
}

} // namespace
} // namespace vcarve
