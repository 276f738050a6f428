#include "steps/6_surface/support.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <set>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::LabelledScene;
using testing::triangular_lattice;

constexpr int kSide = 12;

/// A wall at height 0 that view 0 stands before, 20 below its middle: everything above is solid,
/// everything below free down to a point that nobody saw, so that the wall is not the hull; up
/// to four points that nobody saw. The corners of the wall were all seen from view 0.
Scene wall(const Positions& points, const Vector3d& center)
{
    std::vector<MadePoint> made;
    for (const Vector3d& point : points) {
        made.push_back({point, {0}});
    }
    const Vector3d high = center + Vector3d(0, 0, 50);
    for (const Vector3d& way :
         {Vector3d(1, 0, 0), Vector3d(-1, 0.1, 0), Vector3d(0.1, 1, 0), Vector3d(0, -1, 0)}) {
        made.push_back({high + way, {}});
    }
    made.push_back({center + Vector3d(0, 0, 10), {}});
    return make_scene({center}, made);
}

Labels solid_above(const TetMesh& mesh)
{
    return testing::labels_where(mesh,
                                 [&](Index cell) { return testing::middle(mesh, cell).z() > 0.0; });
}

Scene wall()
{
    return wall(triangular_lattice(kSide, kSide), {8.25, 4.76, -20});
}

/// The number of a point of the lattice.
Index at(int column, int row)
{
    return static_cast<Index>(kSide * row + column);
}

/// Nothing is in the images any more: only tracks tell what was seen.
Scene looking_away(Scene scene)
{
    for (View& view : scene.views) {
        view.cam_from_world = Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX());
    }
    return scene;
}

Scene without_tracks(Scene scene, const std::set<Index>& points)
{
    testing::forget(scene, points);
    return scene;
}

std::set<Index> all_points(const Scene& scene)
{
    std::set<Index> points;
    for (Index i = 0; i < scene.num_points(); ++i) {
        points.insert(i);
    }
    return points;
}

FaceFlags supported(const LabelledScene& made, const SupportOptions& options)
{
    return supported_faces(made.surface, made.facets, made.visibility, made.scene, options);
}

/// The faces of the wall that do not touch any of some points.
FaceFlags wall_but(const LabelledScene& made, const std::set<Index>& points)
{
    FaceFlags flags;
    for (const Face& corners : made.corners) {
        const bool is_wall = std::ranges::all_of(
            corners, [&](Index corner) { return made.mesh.positions[corner].z() == 0.0; });
        const bool touches =
            std::ranges::any_of(corners, [&](Index corner) { return points.contains(corner); });
        flags.push_back(is_wall && !touches ? 1 : 0);
    }
    return flags;
}

std::ptrdiff_t num_kept(const FaceFlags& keep)
{
    return std::ranges::count(keep, 1);
}

// ---- what was seen ------------------------------------------------------------------------------

TEST(SupportedFaces, KeepAPlainWallInAnImageButNotTheShell)
{
    const Scene scene = wall();
    const LabelledScene made(without_tracks(scene, all_points(scene)), solid_above);
    const FaceFlags keep = supported(made, {});
    EXPECT_EQ(keep, wall_but(made, {}));
    EXPECT_EQ(num_kept(keep), 2 * (kSide - 1) * (kSide - 1));
}

TEST(SupportedFaces, KeepWhatTheTracksOfAllCornersSaw)
{
    const LabelledScene made(looking_away(wall()), solid_above);
    EXPECT_EQ(supported(made, {}), wall_but(made, {}));
}

TEST(SupportedFaces, DropAFaceWithACornerThatNobodySaw)
{
    const std::set<Index> unseen = {at(4, 4), at(0, 0)};
    const LabelledScene made(without_tracks(looking_away(wall()), unseen), solid_above);
    EXPECT_EQ(supported(made, {.max_gap_edge = 0.0}), wall_but(made, unseen));
}

/// The wall before which the view stands at 6 degrees, in its image only; one point stands out, so
/// that the face behind it is turned away by so much.
Scene wall_with_crest(double turned_deg)
{
    constexpr double kDegree = std::numbers::pi / 180.0;
    Scene scene = without_tracks(wall(), all_points(wall()));
    Vector3d& crest = scene.positions[at(5, 5)];
    const Vector3d way(0.0, -std::cos(6.0 * kDegree), -std::sin(6.0 * kDegree));
    View& view = scene.views[0];
    view.center = crest + 60.0 * way;
    testing::aim(view, crest);
    crest.z() -= std::sqrt(0.75) * std::tan(turned_deg * kDegree);
    return scene;
}

/// How many faces of the wall with a crest are kept.
std::ptrdiff_t num_kept_beside_crest(double turned_deg)
{
    const LabelledScene made(wall_with_crest(turned_deg), [](const TetMesh& mesh) {
        return testing::labels_where(
            mesh, [&](Index cell) { return testing::middle(mesh, cell).z() > -0.1; });
    });
    const FaceFlags keep = supported(made, {.max_gap_edge = 0.0});
    std::ptrdiff_t kept = 0;
    for (std::size_t face = 0; face < keep.size(); ++face) {
        const bool is_wall = std::ranges::all_of(made.corners[face], [&](Index corner) {
            return std::abs(made.mesh.positions[corner].z()) < 1.0;
        });
        if (is_wall && keep[face] != 0) ++kept;
    }
    return kept;
}

TEST(SupportedFaces, KeepAFaceAmidSeenOnesThatAViewSeesAtOneDegree)
{
    const std::ptrdiff_t all = 2 * (kSide - 1) * (kSide - 1);
    EXPECT_EQ(num_kept_beside_crest(2.0), all);
    EXPECT_EQ(num_kept_beside_crest(3.5), all);
    EXPECT_EQ(num_kept_beside_crest(4.5), all);     // 1.5 degrees are left
    EXPECT_EQ(num_kept_beside_crest(5.2), all - 1); // .8
}

TEST(SupportedFaces, DropAWallSeenOnlyFromBehind)
{
    Scene scene = wall();
    scene.views[0].center.z() = 80.0;
    const LabelledScene made(scene, solid_above);
    EXPECT_EQ(num_kept(supported(made, {})), 0);
}

TEST(SupportedFaces, AreNoneWhereNothingWasSeen)
{
    const Scene four =
        make_scene({}, {{{0, 0, 0}, {}}, {{1, 0, 0}, {}}, {{0, 1, 0}, {}}, {{0, 0, 1}, {}}});
    const LabelledScene made(four, testing::solid);
    EXPECT_EQ(supported(made, {}), FaceFlags(4, 0));
}

// ---- gaps ---------------------------------------------------------------------------------------

/// What is kept of the wall where nobody saw some points of it.
FaceFlags kept_around(const std::set<Index>& unseen, const SupportOptions& options)
{
    const LabelledScene made(without_tracks(looking_away(wall()), unseen), solid_above);
    EXPECT_EQ(num_kept(wall_but(made, {})), 242);
    return supported(made, options);
}

TEST(SupportedFaces, KeepASmallGapAmidSeenFaces)
{
    EXPECT_EQ(num_kept(kept_around({at(4, 4)}, {})), 242);
    EXPECT_EQ(num_kept(kept_around({at(4, 4)}, {.max_gap_edge = 0.0})), 242 - 6);
}

TEST(SupportedFaces, KeepASmallGapInWhoseMiddleNoFaceWasSeen)
{
    EXPECT_EQ(num_kept(kept_around({at(4, 4), at(5, 4)}, {})), 242) << "10 faces";
    EXPECT_EQ(num_kept(kept_around({at(3, 4), at(4, 4), at(5, 4)}, {})), 242) << "14 faces";
    EXPECT_EQ(num_kept(kept_around({at(4, 4), at(5, 4)}, {.max_gap_edge = 0.0})), 242 - 10);
}

TEST(SupportedFaces, JoinGapsThroughEdgesOnly)
{
    // 24 faces in four gaps that touch each other in a vertex, and in four that share edges.
    EXPECT_EQ(num_kept(kept_around({at(2, 3), at(4, 3), at(6, 3), at(8, 3)}, {})), 242);
    EXPECT_EQ(num_kept(kept_around({at(2, 2), at(3, 3), at(4, 4), at(5, 5)}, {})), 242 - 24);
}

TEST(SupportedFaces, DropAGapOnTheHull)
{
    // With everything solid, the wall is the hull, and the gap a part of the shell.
    const std::set<Index> unseen = {at(4, 4)};
    const LabelledScene made(without_tracks(looking_away(wall()), unseen), [](const TetMesh& mesh) {
        Labels labels = solid_above(mesh);
        const Index below = static_cast<Index>(mesh.positions.size()) - 1;
        for (Index cell = 0; cell < labels.size(); ++cell) {
            const auto& vertices = mesh.cells[cell].vertices;
            const bool at_gap = std::ranges::count(vertices, at(4, 4)) > 0;
            if (at_gap && std::ranges::count(vertices, below) > 0) labels[cell] = Label::inside;
        }
        return labels;
    });
    EXPECT_EQ(num_kept(supported(made, {.max_gap_edge = 100.0})), 242 - 6);
}

/// How many faces are kept around a point that nobody saw, amid `spokes` faces 3.3 long and a band
/// of twice as many seen ones.
std::ptrdiff_t kept_of_wheel(int spokes)
{
    Positions points = {{0, 0, 0}};
    for (int i = 0; i < spokes; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / spokes;
        const double next = angle + std::numbers::pi / spokes;
        points.push_back(3.3 * Vector3d(std::cos(angle), std::sin(angle), 0.0));
        points.push_back(4.3 * Vector3d(std::cos(next), std::sin(next), 0.0));
    }
    const LabelledScene made(without_tracks(looking_away(wall(points, {0, 0, -20})), {0}),
                             solid_above);
    EXPECT_EQ(num_kept(wall_but(made, {})), 3 * spokes);
    return num_kept(supported(made, {.max_gap_edge = 5.0}));
}

TEST(SupportedFaces, KeepGapsOfTwentyFacesAndNoLargerOnes)
{
    EXPECT_EQ(kept_of_wheel(20), 60);
    EXPECT_EQ(kept_of_wheel(21), 42);
}

TEST(SupportedFaces, DropAGapThatReachesTheShell)
{
    EXPECT_EQ(num_kept(kept_around({at(5, 0)}, {})), 242 - 3);
}

/// The wall without the two rings of points around one of them, which nobody saw.
struct HoleyWall {
    HoleyWall()
    {
        const Positions lattice = triangular_lattice(kSide, kSide);
        const Vector3d& center = lattice[at(5, 5)];
        Positions points = {center + Vector3d(0.3, 0.1, 0.0)};
        std::ranges::copy_if(lattice, std::back_inserter(points),
                             [&](const Vector3d& point) { return (point - center).norm() > 2.1; });
        made = std::make_unique<LabelledScene>(
            without_tracks(looking_away(wall(points, {8.25, 4.76, -20})), {0}), solid_above);
        for (const Face& corners : made->corners) {
            if (std::ranges::count(corners, 0U) == 0) continue;
            ++unseen;
            for (const Index corner : corners) {
                longest = std::max(longest, (points[corner] - points[0]).norm());
            }
        }
    }
    std::unique_ptr<LabelledScene> made;
    std::ptrdiff_t unseen = 0;
    double longest = 0.0; ///< beside edges of 1 and 1.008 around
};

TEST(SupportedFaces, DropAGapWithAnEdgeTooLong)
{
    const HoleyWall wall;
    const auto all = num_kept(wall_but(*wall.made, {}));
    EXPECT_EQ(num_kept(supported(*wall.made, {.max_gap_edge = 1.01 * wall.longest})), all);
    EXPECT_EQ(num_kept(supported(*wall.made, {.max_gap_edge = 0.98 * wall.longest})),
              all - wall.unseen)
        << "the whole gap, its short edges too";
}

/// A wall of 242 small faces, and beside it one with edges of `step`, of whose points nobody saw
/// one.
FaceFlags kept_of_coarse_wall(double step, const SupportOptions& options)
{
    constexpr Index kCoarse = kSide * kSide;
    Positions points = triangular_lattice(kSide, kSide);
    for (const Vector3d& point : mapped(triangular_lattice(5, 5), step, Vector3d(30, 0, 0))) {
        points.push_back(point);
    }
    const LabelledScene made(
        without_tracks(looking_away(wall(points, {30, 10, -20})), {kCoarse + 12}), solid_above);
    const FaceFlags keep = supported(made, options);
    const FaceFlags seen = wall_but(made, {kCoarse + 12});
    EXPECT_EQ(num_kept(supported(made, {.max_gap_edge = 0.0})), num_kept(seen));
    EXPECT_EQ(num_kept(wall_but(made, {})), num_kept(seen) + 6);
    FaceFlags more;
    for (std::size_t face = 0; face < keep.size(); ++face) {
        if (seen[face] == 0) more.push_back(keep[face]);
    }
    return more;
}

TEST(SupportedFaces, DropAVastGapHoweverSparseThePointsAround)
{
    EXPECT_EQ(num_kept(kept_of_coarse_wall(7.9, {})), 6);
    EXPECT_EQ(num_kept(kept_of_coarse_wall(8.1, {})), 0);
    EXPECT_EQ(num_kept(kept_of_coarse_wall(8.1, {.max_gap_edge = 100.0})), 0);
}

// ---- both ---------------------------------------------------------------------------------------

TEST(SupportedFaces, AreTheSameFromOneThreadAndTwo)
{
    const LabelledScene made(bumpy_sphere(2000, 61), [](const TetMesh& mesh) {
        return testing::labels_where(
            mesh, [&](Index cell) { return testing::middle(mesh, cell).norm() < 0.9; });
    });
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return supported(made, {}); });
    };
    const FaceFlags keep = by(1);
    EXPECT_EQ(by(2), keep);
    EXPECT_GT(num_kept(keep), 0);
}

TEST(WithFaces, LeavesTheVertices)
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0, 0}};
    mesh.faces = {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
    mesh.points = {9, 8, 7, 6, 5};
    const TriMesh some = with_faces(mesh, {1, 0, 1});
    EXPECT_EQ(some.faces, (std::vector<Face>{{0, 1, 2}, {1, 4, 3}}));
    EXPECT_EQ(some.positions, mesh.positions);
    EXPECT_EQ(some.points, mesh.points);
}

} // namespace
} // namespace vcarve
