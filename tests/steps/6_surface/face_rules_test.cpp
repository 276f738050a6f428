#include "geometry/triangle.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/face_rules.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

namespace vcarve::face_rules_test {
namespace {

using Eigen::Vector3d;
using testing::LabeledScene;
using testing::triangular_lattice;

constexpr double kSide = 6.0;
constexpr double kHeight = 3.0;
constexpr double kTop = 15.0; ///< of the surrounding box

// The diameter of the region of interest is 9. The view sees the unsupported ceiling (Part::lid),
// so its faces are dropped from twice the length on.
constexpr double kLong = 2.7;
constexpr FaceRules kSeenFromLong = {.max_closing = kLong / 2.0 / 9.0};

/// A hall without a ceiling. Points are a step apart on its walls and along the edge of its floor,
/// whose center is plain. A view on the floor looks up and sees all of them. Eight optional points
/// far around are seen by no view, but a second view looks down on them.
Scene open_hall(bool has_surroundings = true)
{
    std::vector<MadePoint> points;
    for (const Vector3d& p : lattice(static_cast<int>(kSide) + 1)) {
        const double to_wall = std::min({p.x(), p.y(), kSide - p.x(), kSide - p.y()});
        const bool is_floor = p.z() == 0.0 && to_wall <= 1.0;
        if (is_floor || (to_wall == 0.0 && p.z() <= kHeight)) points.push_back({p, {0}});
    }
    for (const double x : {-30.0, 36.0}) {
        for (const double y : {-30.0, 36.0}) {
            if (!has_surroundings) continue;
            points.push_back({{x, y, -kTop}, {}});
            points.push_back({{x, y, kTop}, {}});
        }
    }
    Scene scene = make_scene({{3.1, 2.8, 0.4}, {3.0, 3.0, 90.0}}, points);
    scene.cameras[0].params = {50.0, 50.0, 320.0, 240.0};
    testing::aim(scene.views[1], {3.0, 3.0, 0.0});
    return scene;
}

/// Labels of which only the hall is free.
Labels around_the_hall(const TetMesh& mesh)
{
    return testing::labels_where(mesh, [&](Index cell) {
        const Vector3d p = testing::middle(mesh, cell);
        return !(p.x() > 0.0 && p.y() > 0.0 && p.x() < kSide && p.y() < kSide && p.z() > 0.0 &&
                 p.z() < kHeight);
    });
}

/// Labels of a surface that continues along the hull: infinite cells are inside.
Labels beyond_the_hull(const TetMesh& mesh)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (std::size_t cell = 0; cell < labels.size(); ++cell) {
        if (mesh.cells[cell].is_infinite()) labels[cell] = Label::inside;
    }
    return labels;
}

/// The location of a face.
enum class Part { hall, lid, top, around };

struct Hall {
    explicit Hall(const Scene& scene = open_hall(),
                  Labels (*label)(const TetMesh&) = around_the_hall)
        : made(scene, label)
    {
        for (const Face& face : made.corners) {
            parts.push_back(part_of(face));
        }
    }
    Part part_of(const Face& face) const
    {
        const auto all_at = [&](double z) {
            return std::ranges::all_of(
                face, [&](Index corner) { return made.mesh.positions[corner].z() == z; });
        };
        if (all_at(kTop)) return Part::top;
        if (all_at(kHeight)) return Part::lid;
        const bool is_far = std::ranges::any_of(
            face, [&](Index corner) { return std::abs(made.mesh.positions[corner].z()) == kTop; });
        return is_far ? Part::around : Part::hall;
    }
    FaceFlags all_but(const std::set<Part>& left_out) const
    {
        FaceFlags keep;
        for (const Part part : parts) {
            keep.push_back(left_out.contains(part) ? 0 : 1);
        }
        return keep;
    }
    double longest_edge(std::size_t face) const
    {
        const auto& [a, b, c] = made.corners[face];
        const auto& positions = made.mesh.positions;
        return std::max({(positions[a] - positions[b]).norm(), (positions[b] - positions[c]).norm(),
                         (positions[c] - positions[a]).norm()});
    }
    /// `keep` without the faces of a part that have an edge of at least `edge`.
    FaceFlags without(FaceFlags keep, Part part, double edge) const
    {
        for (std::size_t face = 0; face < keep.size(); ++face) {
            if (parts[face] == part && longest_edge(face) >= edge) keep[face] = 0;
        }
        return keep;
    }
    /// `keep` without the first long face of the ceiling, so that it gets a boundary.
    FaceFlags opened(FaceFlags keep, double edge = kLong) const
    {
        for (std::size_t face = 0; face < keep.size(); ++face) {
            if (parts[face] != Part::lid || longest_edge(face) < edge) continue;
            keep[face] = 0;
            break;
        }
        return keep;
    }
    std::int64_t drop(const FaceRules& rules, FaceFlags& keep) const
    {
        return drop_unsupported({made.surface, made.facets, made.visibility}, rules, keep);
    }

    LabeledScene made;
    std::vector<Part> parts;
};

/// Fails unless exactly the faces missing in `expected` are dropped.
void expect_dropped(const Hall& hall, const FaceRules& rules, FaceFlags keep,
                    const FaceFlags& expected)
{
    const auto before = std::ranges::count(keep, 1);
    EXPECT_EQ(hall.drop(rules, keep), before - std::ranges::count(expected, 1));
    EXPECT_EQ(keep, expected);
}

TEST(DropUnsupported, DropsUnsupportedCeilingOfAnOpenHallButNotItsPlainFloor)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    const FaceFlags without_lid = hall.without(keep, Part::lid, kLong);
    const FaceFlags without_floor = hall.without(keep, Part::hall, kLong);
    ASSERT_NE(without_lid, keep);
    ASSERT_NE(without_floor, keep) << "the floor has long faces, too";
    expect_dropped(hall, kSeenFromLong, keep, without_lid);
}

TEST(DropUnsupported, DropsVisibleFacesOnlyIfTwiceAsLong)
{
    constexpr double kVast = 5.4; // between the lengths of the faces of the ceiling
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}), kVast);
    const FaceFlags rest = hall.without(keep, Part::lid, kVast);
    ASSERT_NE(rest, keep);
    ASSERT_NE(hall.without(rest, Part::lid, kVast / 1.7), rest);
    expect_dropped(hall, {.max_closing = kVast / 2.0 / 9.0}, keep, rest);
}

TEST(DropUnsupported, KeepsVisibleFacesAwayFromTheBoundary)
{
    const Hall hall;
    const FaceFlags keep = hall.all_but({Part::top, Part::around});
    expect_dropped(hall, kSeenFromLong, keep, keep);
}

TEST(DropUnsupported, KeepsFacesBelowTheLength)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    ASSERT_NE(hall.without(keep, Part::lid, 9.0 * 0.5), keep);
    expect_dropped(hall, {.max_closing = 0.475}, keep, keep);
}

TEST(DropUnsupported, KeepsAllFacesIfDisabled)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({}));
    expect_dropped(hall, {.max_closing = 0.0}, keep, keep);
}

TEST(DropUnsupported, KeepsFacesThatHideTheBackOfAKeptFace)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::around}));
    expect_dropped(hall, kSeenFromLong, keep, keep);
}

TEST(DropUnsupported, DropsUnseenHullFacesAndThenTheFacesInFrontOfThem)
{
    // The surrounding box is dropped first, because no view looks at it. Then the ceiling hides no
    // back.
    Hall hall;
    hall.made.scene.views[1].center.z() = -90.0; // made.visibility refers to this scene
    testing::aim(hall.made.scene.views[1], {3.0, 3.0, -200.0});
    const FaceFlags keep = hall.opened(hall.all_but({}));
    const FaceFlags open = hall.opened(hall.all_but({Part::top, Part::around}));
    expect_dropped(hall, kSeenFromLong, keep, hall.without(open, Part::lid, kLong));
}

TEST(DropUnsupported, KeepsFacesInFrontOfInfiniteCells)
{
    const Hall hall(open_hall(false), beyond_the_hull);
    const FaceFlags keep = hall.opened(hall.all_but({}));
    ASSERT_NE(hall.without(keep, Part::lid, kLong), keep);
    expect_dropped(hall, kSeenFromLong, keep, keep);
}

TEST(DropUnsupported, CountsNoFaceThatWasDroppedBefore)
{
    const Hall hall;
    const FaceFlags none(hall.parts.size(), 0);
    expect_dropped(hall, kSeenFromLong, none, none);
}

TEST(DropUnsupported, IsTheSameForAnyThreadCount)
{
    const Hall hall;
    const auto by = [&](int threads) {
        FaceFlags keep = hall.all_but({});
        testing::with_threads(threads, [&] { return hall.drop(kSeenFromLong, keep); });
        return keep;
    };
    EXPECT_EQ(by(1), by(2));
}

// ---- small faces beside kept ones ---------------------------------------------------------------

constexpr int kSlabSide = 7;

/// Points a step apart on the top and the bottom of a slab, which two views show from above, and
/// eight unseen points far around.
Scene slab(double thickness)
{
    std::vector<MadePoint> points;
    for (int i = 0; i < kSlabSide; ++i) {
        for (int j = 0; j < kSlabSide; ++j) {
            const double off = 0.01 * std::sin(5.0 * i + 3.0 * j * j);
            points.push_back({{i + off, j - off, 0.0}, {0, 1}});
            points.push_back({{i - off, j + off, -thickness}, {}});
        }
    }
    for (const double x : {-40.0, 46.0}) {
        for (const double y : {-41.0, 47.0}) {
            points.push_back({{x, y, -60.0}, {}});
            points.push_back({{x, y, 55.0}, {}});
        }
    }
    Scene scene = make_scene({{3.1, 2.8, 40.0}, {3.3, 2.9, 41.0}}, points);
    for (View& view : scene.views) {
        testing::aim(view, {3.0, 3.0, 0.0});
    }
    return scene;
}

struct Slab {
    explicit Slab(double thickness = 1.0)
        : made(slab(thickness), [&](const TetMesh& mesh) {
              return testing::labels_where(mesh, [&](Index cell) {
                  return std::ranges::all_of(mesh.cells[cell].vertices, [&](Index v) {
                      return std::abs(mesh.positions[v].x()) < 20.0;
                  });
              });
          })
    {
        for (const Face& face : made.surface.faces) {
            top.push_back(face_normal(made.surface.positions, face).z() > 0.9 ? 1 : 0);
            rest.push_back(top.back() == 0 ? 1 : 0);
        }
    }
    FaceFlags all() const { return FaceFlags(top.size(), 1); }
    bool shares_an_edge_with_top(std::size_t face) const
    {
        const auto& faces = made.surface.faces;
        for (std::size_t other = 0; other < faces.size(); ++other) {
            const auto common = std::ranges::count_if(faces[face], [&](std::uint32_t corner) {
                return std::ranges::count(faces[other], corner) > 0;
            });
            if (top[other] != 0 && common == 2) return true;
        }
        return false;
    }
    Boundary boundary() const { return {made.surface, made.facets, made.visibility}; }
    ChosenFaces chosen(const SurfaceOptions& options = {}) const
    {
        Removals nobody_asks(nullptr);
        return choose_faces(boundary(), nullptr, options, nobody_asks);
    }
    FaceFlags dropped(FaceFlags keep, double max_closing) const
    {
        const auto before = std::ranges::count(keep, 1);
        const std::int64_t count = drop_unsupported(boundary(), {.max_closing = max_closing}, keep);
        EXPECT_EQ(count, before - std::ranges::count(keep, 1));
        return keep;
    }

    LabeledScene made;
    FaceFlags top;
    FaceFlags rest;
};

TEST(ChooseFaces, KeepsSmallUnseenFacesBesideKeptOnes)
{
    const Slab slab;
    FaceFlags expected = slab.top;
    for (std::size_t face = 0; face < expected.size(); ++face) {
        if (slab.shares_an_edge_with_top(face)) expected[face] = 1;
    }
    ASSERT_NE(expected, slab.top);
    ASSERT_NE(expected, slab.all());
    const ChosenFaces chosen = slab.chosen();
    EXPECT_EQ(chosen.keep, expected);
    EXPECT_EQ(chosen.seen, slab.top);
    EXPECT_EQ(chosen.unseen, std::ranges::count(expected, 0));
    EXPECT_EQ(chosen.closing, 0);
}

TEST(ChooseFaces, DropsAllUnseenFacesIfDisabled)
{
    SurfaceOptions options;
    options.rules.beside_edge = 0.0;
    const Slab slab;
    EXPECT_EQ(slab.chosen(options).keep, slab.top);
}

TEST(ChooseFaces, DropsLargeUnseenFacesBesideKeptOnes)
{
    EXPECT_EQ(Slab(4.5).chosen().keep, Slab(4.5).top) << "longer than three local edges";
    SurfaceOptions options;
    options.rules.beside_edge = 10.0;
    EXPECT_NE(Slab(4.5).chosen(options).keep, Slab(4.5).top);
    options.rules.beside_length = 3.0; // the median on top is 1.4
    EXPECT_EQ(Slab(4.5).chosen(options).keep, Slab(4.5).top);
}

TEST(ChooseFaces, KeepsAllFacesOfAClosedSurface)
{
    SurfaceOptions options;
    options.closed = true;
    const Slab slab;
    EXPECT_EQ(slab.chosen(options).keep, slab.all());
}

TEST(CarveSurface, EndsBehindTheBendThatLeavesTheView)
{
    const Slab slab;
    const CarvedSurface made =
        carve_surface(slab.made.labels, {slab.made.mesh, slab.made.scene}, {}, {});
    EXPECT_EQ(std::ssize(made.faces.faces), std::ranges::count(slab.chosen().keep, 1));
}

TEST(DropUnsupported, DropsHardlySeenBoundaryFacesOfAnySize)
{
    const Slab slab;
    FaceFlags keep = slab.all();
    keep[static_cast<std::size_t>(std::ranges::find(slab.rest, 1) - slab.rest.begin())] = 0;
    EXPECT_EQ(slab.dropped(keep, 0.9), slab.top);
    EXPECT_EQ(slab.dropped(keep, 0.0), keep) << "0 disables";
    EXPECT_EQ(slab.dropped(slab.all(), 0.9), slab.all()) << "no face is at the boundary";
}

TEST(DropUnsupported, DropsLongMostlyUnseenFacesAnywhere)
{
    const Slab slab;
    EXPECT_EQ(slab.dropped(slab.all(), 0.01), slab.top);
}

// ---- seen faces ---------------------------------------------------------------------------------

constexpr int kWallSide = 12;

/// A wall at height 0, whose points view 0 saw from 20 below its center. Space above is solid, up
/// to four unseen points. Space below is free, down to an unseen point, so the wall is not on the
/// hull.
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
    return wall(triangular_lattice(kWallSide, kWallSide), {8.25, 4.76, -20});
}

/// The index of a lattice point.
Index at(int column, int row)
{
    return static_cast<Index>(kWallSide * row + column);
}

/// Turns the views away, so that only tracks show which points were seen.
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

FaceFlags seen(const LabeledScene& made)
{
    return seen_faces({made.surface, made.facets, made.visibility});
}

/// The faces of the wall without any of some points as corners.
FaceFlags wall_but(const LabeledScene& made, const std::set<Index>& points)
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

TEST(SeenFaces, IncludeAPlainWallInAnImageButNotTheFacesAround)
{
    const Scene scene = wall();
    const LabeledScene made(without_tracks(scene, all_points(scene)), solid_above);
    const FaceFlags keep = seen(made);
    EXPECT_EQ(keep, wall_but(made, {}));
    EXPECT_EQ(num_kept(keep), 2 * (kWallSide - 1) * (kWallSide - 1));
}

TEST(SeenFaces, IncludeFacesWhoseCornersAreInTracks)
{
    const LabeledScene made(looking_away(wall()), solid_above);
    EXPECT_EQ(seen(made), wall_but(made, {}));
}

TEST(SeenFaces, ExcludeFacesWithAnUnseenCorner)
{
    const std::set<Index> unseen = {at(4, 4), at(0, 0)};
    const LabeledScene made(without_tracks(looking_away(wall()), unseen), solid_above);
    EXPECT_EQ(seen(made), wall_but(made, unseen));
}

TEST(SeenFaces, ExcludeAWallSeenOnlyFromBehind)
{
    Scene scene = wall();
    scene.views[0].center.z() = 80.0;
    const LabeledScene made(scene, solid_above);
    EXPECT_EQ(num_kept(seen(made)), 0);
}

TEST(SeenFaces, AreEmptyWithoutViews)
{
    const Scene four =
        make_scene({}, {{{0, 0, 0}, {}}, {{1, 0, 0}, {}}, {{0, 1, 0}, {}}, {{0, 0, 1}, {}}});
    const LabeledScene made(four, testing::solid);
    EXPECT_EQ(seen(made), FaceFlags(4, 0));
}

TEST(SeenFaces, AreTheSameForAnyThreadCount)
{
    const LabeledScene made(bumpy_sphere(2000, 61), [](const TetMesh& mesh) {
        return testing::labels_where(
            mesh, [&](Index cell) { return testing::middle(mesh, cell).norm() < 0.9; });
    });
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return seen(made); });
    };
    const FaceFlags keep = by(1);
    EXPECT_EQ(by(2), keep);
    EXPECT_GT(num_kept(keep), 0);
}

TEST(WithFaces, KeepsAllVertices)
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
} // namespace vcarve::face_rules_test
