#include "geometry/triangle.h"
#include "steps/5_labels/boundary.h"
#include "support/made_cells.h"
#include "support/scenes.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace vcarve::boundary_test {
namespace {

using Eigen::Vector3d;

TEST(Boundary, HasAnOutwardFaceForEachFacet)
{
    const Scene scene = bumpy_sphere(300, 71);
    const TetMesh mesh = triangulate(scene);
    const Labels labels = testing::labels_where(
        mesh, [&](Index cell) { return testing::middle(mesh, cell).norm() < 0.9; });
    const std::vector<CellFacet> facets = boundary_facets(mesh, labels);
    const std::vector<Face> faces = boundary_faces(mesh, facets);
    std::size_t expected = 0;
    for (const Cell& cell : mesh.cells) {
        const bool is_inside =
            labels[static_cast<std::size_t>(&cell - mesh.cells.data())] == Label::inside;
        for (const Index neighbor : cell.neighbors) {
            if (is_inside && labels[neighbor] == Label::outside) ++expected;
        }
    }
    ASSERT_EQ(facets.size(), expected);
    ASSERT_EQ(faces.size(), expected);
    for (std::size_t i = 0; i < expected; ++i) {
        const auto [cell, slot] = facets[i];
        EXPECT_EQ(labels[cell], Label::inside);
        EXPECT_EQ(labels[mesh.cells[cell].neighbors[slot]], Label::outside);
        const Vector3d& behind = mesh.positions[mesh.cells[cell].vertices[slot]];
        const auto& [a, b, c] = faces[i];
        EXPECT_LT(face_normal(mesh.positions, faces[i]).dot(behind - mesh.positions[a]), 0.0);
        EXPECT_EQ(testing::cell_of(mesh, {a, b, c, mesh.cells[cell].vertices[slot]}), cell);
        EXPECT_EQ(place_of(facets[i], facets), i);
    }
}

TEST(CloseHull, LabelsOnlyInfiniteCellsOutside)
{
    const TetMesh mesh = triangulate(bumpy_sphere(60, 3));
    Labels labels(mesh.cells.size(), Label::inside);
    close_hull(mesh, labels);
    for (std::size_t cell = 0; cell < labels.size(); ++cell) {
        EXPECT_EQ(labels[cell] == Label::outside, mesh.cells[cell].is_infinite());
    }
}

/// Points spread evenly on the unit sphere below z = 0.3, where it is open, each seen by `views`.
std::vector<MadePoint> round_room(const std::vector<std::uint32_t>& views)
{
    constexpr int kPoints = 600;
    std::vector<MadePoint> points;
    for (int i = 0; i < kPoints; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / kPoints;
        const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double radius = std::sqrt(1.0 - z * z);
        if (z < 0.3)
            points.push_back({{radius * std::cos(turn), radius * std::sin(turn), z}, views});
    }
    return points;
}

const std::vector<Vector3d> kWithin = {
    {0.1, 0.0, 0.0}, {-0.2, 0.1, 0.1}, {0.0, -0.2, -0.1}, {0.1, 0.2, -0.2}};

/// A room with all cells outside, as after carving by rays from within.
struct FreeRoom {
    explicit FreeRoom(Scene made)
        : scene(std::move(made)),
          mesh(triangulate(scene)),
          labels(mesh.cells.size(), Label::outside)
    {
        network.arc_capacities = filled_array(mesh.cells.size(), std::array<std::int32_t, 4>{});
    }

    std::int64_t go_on() { return continue_along_hull(mesh, scene, uncrossed(), {}, labels); }
    std::vector<CellFacet> facets() const { return boundary_facets(mesh, labels); }
    std::vector<Index> uncrossed() const { return uncrossed_hull_cells(mesh, network); }
    std::int64_t num_on_hull() const
    {
        return std::ranges::count_if(mesh.cells,
                                     [](const Cell& cell) { return cell.is_infinite(); });
    }
    /// Whether a hull facet is on the open top: it has edges of .95 to the center. Edges on walls
    /// are much shorter.
    bool is_on_lid(Index cell) const { return longest_edge(cell) > 0.7; }
    double longest_edge(Index cell) const
    {
        const auto& [a, b, c, infinite] = mesh.cells[cell].vertices;
        const auto length = [&](Index v, Index w) {
            return (mesh.positions[v] - mesh.positions[w]).norm();
        };
        return std::max({length(a, b), length(b, c), length(c, a)});
    }

    Scene scene;
    TetMesh mesh;
    Labels labels;
    FlowNetwork network;
};

TEST(GoOnAlongHull, AddsTheWallsOfARoomWithoutPointsBehindThem)
{
    FreeRoom room(make_scene(kWithin, round_room({0, 1, 2, 3})));
    const std::int64_t found = room.go_on();
    const std::vector<CellFacet> facets = room.facets();
    EXPECT_EQ(found, size_of(facets.size()));
    EXPECT_GT(found, room.num_on_hull() * 9 / 10);
    for (const CellFacet& facet : facets) {
        EXPECT_EQ(facet.slot, 3) << "only these facets of infinite cells are bounded";
        const Face face = face_of(room.mesh, facet);
        EXPECT_LT(face_normal(room.mesh.positions, face).dot(room.mesh.positions[face[0]]), 0.0)
            << "walls must face the room";
    }
}

TEST(GoOnAlongHull, IsUndoneByCloseHull)
{
    FreeRoom room(make_scene(kWithin, round_room({0, 1, 2, 3})));
    ASSERT_GT(room.go_on(), 0);
    close_hull(room.mesh, room.labels);
    EXPECT_TRUE(room.facets().empty());
}

TEST(GoOnAlongHull, RejectsFacetsThatViewsSawFromOutside)
{
    // With views far out on all sides, the inner side of the walls cannot be distinguished.
    std::vector<Vector3d> views = kWithin;
    for (const double far : {-9.0, 9.0}) {
        views.insert(views.end(), {{far, 0.0, 0.0}, {0.0, far, 0.0}, {0.0, 0.0, far}});
    }
    FreeRoom room(make_scene(views, round_room({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})));
    EXPECT_EQ(room.go_on(), 0);
}

TEST(GoOnAlongHull, RejectsFacetsInTheImageOfAViewOutside)
{
    // A view below the room, which saw none of its points, looks at the back of the floor.
    std::vector<Vector3d> views = kWithin;
    views.emplace_back(0.0, 0.0, -9.0);
    Scene scene = make_scene(views, round_room({0, 1, 2, 3}));
    FreeRoom room(scene);
    room.go_on();
    const std::vector<CellFacet> facets = room.facets();
    EXPECT_FALSE(facets.empty());
    for (const CellFacet& facet : facets) {
        const Face face = face_of(room.mesh, facet);
        const Vector3d to_view = views.back() - room.mesh.positions[face[0]];
        EXPECT_GE(face_normal(room.mesh.positions, face).dot(to_view), 0.0);
    }

    // Without this view there are more facets.
    const auto blind = FreeRoom(make_scene(kWithin, round_room({0, 1, 2, 3}))).go_on();
    EXPECT_LT(size_of(facets.size()), blind);
}

TEST(GoOnAlongHull, RejectsFacetsThatNoViewSawFromWithin)
{
    FreeRoom room(make_scene({{0.0, 0.0, 9.0}, {0.5, 0.0, 9.0}}, round_room({0, 1})));
    room.go_on();
    for (const CellFacet& facet : room.facets()) {
        const Face face = face_of(room.mesh, facet);
        EXPECT_LT(room.mesh.positions[face[0]].z(), 0.25) << "views above see only the back";
    }
}

TEST(GoOnAlongHull, RejectsFacetsThatRaysCross)
{
    FreeRoom room(make_scene(kWithin, round_room({0, 1, 2, 3})));
    const std::vector<Index> all = room.uncrossed();
    ASSERT_EQ(size_of(all.size()), room.num_on_hull());
    const CellFacet outwards = room.mesh.other_side({all[3], 3});
    room.network.arc_capacities[outwards.cell][outwards.slot] = 1;
    room.network.arc_capacities[all[5]][3] = 1;
    std::vector<Index> expected = all;
    expected.erase(expected.begin() + 5);
    expected.erase(expected.begin() + 3);
    EXPECT_EQ(room.uncrossed(), expected);
}

TEST(GoOnAlongHull, RejectsFacetsAtAnAngleToTheSurface)
{
    std::vector<MadePoint> points = round_room({0, 1, 2, 3});
    points.push_back({{0.0, 0.0, 0.4}, {0, 1, 2, 3}}); // so that the top is a fan of facets
    FreeRoom room(make_scene(kWithin, points));
    const auto is_on_lid = [&](Index cell) { return room.is_on_lid(cell); };
    ASSERT_TRUE(std::ranges::any_of(room.uncrossed(), is_on_lid));
    room.go_on();
    for (const CellFacet& facet : room.facets()) {
        EXPECT_FALSE(room.is_on_lid(facet.cell));
    }
}

/// The number of hull facets that continue the surface of a flat bowl to a point at distance `far`
/// from its rim. The point spacing of the bowl is 1.
std::int64_t num_going_on(double far)
{
    std::vector<MadePoint> points;
    const auto add = [&](double x, double y) {
        points.push_back({{x, y, 1e-4 * (x * x + y * y)}, {0, 1}});
    };
    for (int i = -5; i <= 5; ++i) {
        for (int k = -5; k <= 5; ++k) {
            add(i, k + 0.01 * i);
        }
    }
    add(5.0 + far, 0.0);
    FreeRoom plain(make_scene({{0.0, 1.0, 50.0}, {2.0, 0.0, 50.0}}, points));
    plain.go_on();
    std::int64_t num_long = 0;
    for (const CellFacet& facet : plain.facets()) {
        num_long += plain.longest_edge(facet.cell) > 0.9 * far ? 1 : 0;
    }
    return num_long;
}

TEST(GoOnAlongHull, AcceptsEdgesUpToTwentyTimesTheLocalLength)
{
    // The local length is up to 2 at the corners of some facets.
    EXPECT_GT(num_going_on(15.0), 0);
    EXPECT_GT(num_going_on(30.0), 0);
    EXPECT_EQ(num_going_on(45.0), 0);
}

TEST(Reconstruct, FindsWallsSeenOnlyFromWithin)
{
    Log log;
    Scene scene = make_scene(kWithin, round_room({0, 1, 2, 3}));
    const TriMesh mesh = reconstruct(scene, {}, log).mesh;
    EXPECT_GT(mesh.faces.size(), 650U);
    Options closed;
    closed.surface.closed = true;
    EXPECT_THROW(reconstruct(scene, closed, log), InputError) << "no points are behind the walls";
}

} // namespace
} // namespace vcarve::boundary_test
