#include "support/scenes.h"
#include "surface/webs.h"
#include "tetra/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Everything below the plate is inside.
Labels below_the_plate(const TetMesh& mesh)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Cell& cell = mesh.cells[i];
        if (!cell.is_infinite() && middle(mesh, cell).z() < 0.0) {
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

TEST(Webs, AreNotSeenInASurfaceThatRunsOn)
{
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    EXPECT_TRUE(cells_behind_webs(mesh, {mesh, below_the_plate(mesh)}, scene, {}).empty());
}

TEST(Webs, AreLongSeenFacesAcrossTheSurface)
{
    const Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    const Index tall = tall_cell(mesh);
    ASSERT_NE(tall, kInfinite);
    Labels labels = below_the_plate(mesh);
    labels[tall] = Label::inside;

    const auto doubted = cells_behind_webs(mesh, {mesh, labels}, scene, {});
    EXPECT_EQ(std::set<Index>(doubted.begin(), doubted.end()), std::set<Index>{tall});
    EXPECT_LE(doubted.size(), 3U) << "once for each of its faces that stand on the plate";
    EXPECT_TRUE(cells_behind_webs(mesh, {mesh, labels}, scene, {.web_edge = 0.0}).empty());
    EXPECT_TRUE(cells_behind_webs(mesh, {mesh, labels}, scene, {.web_edge = 50.0}).empty());
}

TEST(Webs, AreOnlyWhatWasSeen)
{
    Scene scene = plate_and_tip();
    const TetMesh mesh = triangulate(scene);
    Labels labels = below_the_plate(mesh);
    labels[tall_cell(mesh)] = Label::inside;
    std::fill(scene.tracks.begins.begin() + kTip + 1, scene.tracks.begins.end(),
              scene.tracks.begins[kTip]); // nobody saw the tip
    scene.tracks.views.resize(scene.tracks.begins[kTip]);
    EXPECT_TRUE(cells_behind_webs(mesh, {mesh, labels}, scene, {}).empty());
}

} // namespace
} // namespace vcarve
