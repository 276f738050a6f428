#include "steps/2_planes/added_points.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace vcarve::border_candidates_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using flat_scenes::ball;
using flat_scenes::flat;
using flat_scenes::kAll;
using flat_scenes::kCenters;
using flat_scenes::kSpacing;
using flat_scenes::points_of_kind;
using flat_scenes::together;
using flat_scenes::track_of;
using flat_scenes::Views;

/// Adds points only on borders.
const AddedPointOptions kOnBorders = {.crease_reach = 0.0, .textureless_step = 0.0};

/// A board in front of the views, 1 wide and .8 high.
std::vector<MadePoint> board(const Views& views = kAll)
{
    return flat({-0.5, -0.4}, {0.5, 0.4}, views,
                [](double u, double v) { return Vector3d(u, v, 0.0); });
}

/// A rough surface far behind the board, with denser points in the images.
std::vector<MadePoint> backdrop(const Views& views = kAll)
{
    return flat({-1.6, -1.4}, {1.6, 1.4}, views, [](double u, double v) {
        return Vector3d(u, v, 1.5 + 0.3 * std::sin(40.0 * u + 100.0 * v));
    });
}

/// The part of the backdrop that all views see past the board, at least `beyond` from its border.
std::vector<MadePoint> seen_backdrop(double beyond = 0.05)
{
    std::vector<MadePoint> seen = backdrop();
    std::erase_if(seen, [&](const MadePoint& point) {
        return std::ranges::any_of(kCenters, [&](const Vector3d& center) {
            const double share = center.z() / (center.z() - point.position.z());
            const Vector3d at = center + share * (point.position - center);
            return std::abs(at.x()) < 0.5 + beyond && std::abs(at.y()) < 0.4 + beyond;
        });
    });
    return seen;
}

std::vector<std::size_t> added_points(const Scene& scene)
{
    return points_of_kind(scene, PointKind::border);
}

std::int64_t num_added(Scene scene, const AddedPointOptions& options = kOnBorders)
{
    return add_points(scene, options).added;
}

TEST(BorderCandidates, AreAddedAroundABoard)
{
    const Scene before = together({board(), seen_backdrop()});
    Scene scene = before;
    const AddedPoints report = add_points(scene, kOnBorders);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_EQ(report.added, std::ssize(added));
    EXPECT_EQ(scene.num_points(), before.num_points() + added.size());
    // Most of the border, 3.6 long, has points.
    EXPECT_GT(added.size(), 20U);
    EXPECT_LT(added.size(), 70U);
}

TEST(BorderCandidates, AreNotAddedToDenseClouds)
{
    Scene scene = together({board(), seen_backdrop()});
    scene.is_dense = true;
    EXPECT_EQ(num_added(scene), 0);
}

TEST(BorderCandidates, AreInThePlaneBesideTheBoard)
{
    Scene scene = together({board(), seen_backdrop()});
    add_points(scene, kOnBorders);
    for (const std::size_t i : added_points(scene)) {
        const Vector3d& at = scene.positions[i];
        EXPECT_LT(std::abs(at.z()), 0.01 * kSpacing);
        const double beyond = std::max(std::abs(at.x()) - 0.5, std::abs(at.y()) - 0.4);
        EXPECT_GT(beyond, -0.5 * kSpacing) << "inside the board";
        EXPECT_LT(beyond, 1.0 * kSpacing) << "far from the board";
    }
}

TEST(BorderCandidates, HaveTheViewsOfPointsBesideThem)
{
    Scene scene = together({board(), seen_backdrop()});
    add_points(scene, kOnBorders);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), kAll);
        EXPECT_EQ(scene.errors_px[i], 0.5);
    }
}

TEST(BorderCandidates, AreOnAllSides)
{
    Scene scene = together({board(), seen_backdrop()});
    add_points(scene, kOnBorders);
    std::array<int, 4> sides{};
    for (const std::size_t i : added_points(scene)) {
        const Vector3d& at = scene.positions[i];
        sides[0] += at.x() < -0.47;
        sides[1] += at.x() > 0.47;
        sides[2] += at.y() < -0.37;
        sides[3] += at.y() > 0.37;
    }
    EXPECT_GE(std::ranges::min(sides), 3);
}

TEST(BorderCandidates, AreApartFromOtherPoints)
{
    // Some rays pass so close to the board that a candidate would be at a point.
    Scene scene = together({board(), seen_backdrop(0.02)});
    add_points(scene, kOnBorders);
    const std::vector<std::size_t> added = added_points(scene);
    for (const std::size_t i : added) {
        for (std::size_t other = 0; other < scene.num_points(); ++other) {
            if (other == i) continue;
            const bool is_added = scene.kind_of(other) == PointKind::border;
            EXPECT_GT((scene.positions[other] - scene.positions[i]).norm(),
                      (is_added ? 0.4 : 0.15) * kSpacing);
        }
    }
}

TEST(BorderCandidates, NeedRaysBesideTheBoard)
{
    EXPECT_EQ(num_added(together({board()})), 0);
    // Rays only to the right of it
    auto right = seen_backdrop();
    std::erase_if(right, [](const MadePoint& point) { return point.position.x() < 0.7; });
    Scene scene = together({board(), right});
    add_points(scene, kOnBorders);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_GE(added.size(), 4U);
    for (const std::size_t i : added) {
        EXPECT_GT(scene.positions[i].x(), 0.2);
    }
}

TEST(BorderCandidates, NeedRaysWithinTheGap)
{
    // No ray passes within 2.5 spacings of the board.
    const auto far = seen_backdrop(0.25);
    const Scene scene = together({board(), far});
    EXPECT_GT(num_added(scene, {.crease_reach = 0.0, .border_gap = 4.0, .textureless_step = 0.0}),
              8);
    EXPECT_EQ(num_added(scene, {.crease_reach = 0.0, .border_gap = 1.5, .textureless_step = 0.0}),
              0);
    EXPECT_EQ(num_added(together({board(), seen_backdrop()}),
                        {.crease_reach = 0.0, .border_gap = 0.0, .textureless_step = 0.0}),
              0);
}

TEST(BorderCandidates, NeedARegionOf20Points)
{
    auto small = board();
    std::erase_if(small, [](const MadePoint& point) {
        return std::abs(point.position.x()) > 0.18 || std::abs(point.position.y()) > 0.23;
    });
    ASSERT_LT(small.size(), 20U);
    ASSERT_GE(small.size(), 12U);
    std::vector<MadePoint> far; // seen past the border, on all sides
    for (int i = 0; i < 400; ++i) {
        const double turn = 0.1 * i;
        const double radius = 0.4 + 0.001 * i;
        far.push_back(
            {{radius * std::cos(turn), radius * std::sin(turn), 1.5 + 0.5 * std::sin(i * i)},
             kAll});
    }
    EXPECT_EQ(num_added(together({small, far})), 0);
}

TEST(BorderCandidates, AreNotAddedToACurvedSurface)
{
    // Rays pass close to flat parts of a ball, but these have no border.
    EXPECT_EQ(num_added(together({ball(8000, -0.2)})), 0);
}

TEST(BorderCandidates, AreNotAddedBesideOtherObjects)
{
    // A rough object touches the board on the right, like a hedge at a wall.
    std::mt19937 random(11);
    std::uniform_real_distribution<double> across(0.53, 0.72);
    std::uniform_real_distribution<double> up(-0.45, 0.45);
    std::uniform_real_distribution<double> deep(-0.08, 0.08);
    std::vector<MadePoint> hedge(150);
    for (MadePoint& point : hedge) {
        point = {{across(random), up(random), deep(random)}, kAll};
    }
    Scene scene = together({board(), hedge, seen_backdrop()});
    add_points(scene, kOnBorders);
    const auto is_right = [&](std::size_t i) { return scene.positions[i].x() > 0.5; };
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_GE(added.size(), 15U);
    EXPECT_LE(std::ranges::count_if(added, is_right), 1);
}

TEST(BorderCandidates, HaveOnlyViewsWhoseImagesShowThem)
{
    // The last view's image ends above the lower part of the board.
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.0, -3.0, -6.0);
    Scene scene = together({board({0, 1, 2, 3}), seen_backdrop()}, centers);
    ASSERT_GT(add_points(scene, kOnBorders).added, 10);
    std::ptrdiff_t above = 0;
    for (const std::size_t i : added_points(scene)) {
        const Views track = track_of(scene, i);
        EXPECT_TRUE(std::ranges::includes(track, kAll));
        above += std::ranges::count(track, 3U);
    }
    EXPECT_LT(above, std::ssize(added_points(scene)));
}

/// The last center is behind the steep board.
const std::vector<Vector3d> kBesideSteep = {{1, 0, -6}, {1.5, -0.3, -6}, {2, 0, -6}, {-2.5, 0, -6}};

/// A board that three views see from the right, and points that they see past its upper border.
Scene steep_board(const Views& views)
{
    const auto steep = flat({-0.5, -0.4}, {0.5, 0.4}, views,
                            [](double u, double v) { return Vector3d(0.2 * u, v, u); });
    const auto far = flat({-1.0, -0.95}, {-0.2, -0.62}, {0, 1, 2}, [](double u, double v) {
        return Vector3d(u, v, 1.5 + 0.2 * std::sin(40.0 * u + 100.0 * v));
    });
    return together({steep, far}, kBesideSteep);
}

TEST(BorderCandidates, HaveOnlyViewsInFrontOfThePlane)
{
    Scene scene = steep_board({0, 1, 2, 3});
    ASSERT_GT(add_points(scene, kOnBorders).added, 3);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), kAll);
    }
}

TEST(BorderCandidates, NeedTwoViews)
{
    EXPECT_GT(num_added(steep_board({0, 1, 3})), 3);
    EXPECT_EQ(num_added(steep_board({0, 3})), 0);
}

TEST(BorderCandidates, AreApartFromCreasePoints)
{
    // A floor in front of the board, with crease points at the board's lower border.
    const auto floor = flat({-0.5, 0.05}, {0.5, 1.0}, kAll,
                            [](double u, double v) { return Vector3d(u, 0.45, -v); });
    Scene scene = together({board(), floor, seen_backdrop()});
    const std::int64_t added = add_points(scene, {}).added;
    EXPECT_GT(std::ssize(added_points(scene)), 10);
    EXPECT_GT(added - std::ssize(added_points(scene)), 5);
    for (const std::size_t i : added_points(scene)) {
        for (std::size_t other = 0; other < scene.num_points(); ++other) {
            if (scene.kind_of(other) != PointKind::crease) continue;
            EXPECT_GT((scene.positions[other] - scene.positions[i]).norm(), 0.4 * kSpacing);
        }
    }
}

TEST(BorderCandidates, DoNotDependOnUnitAndPosition)
{
    flat_scenes::expect_same_elsewhere(together({board(), seen_backdrop()}), kOnBorders,
                                       PointKind::border, {1.0 / 1024.0, 37.3, 1e6}, 1e-9);
}

TEST(BorderCandidates, DoNotDependOnRotation)
{
    const Scene scene = together({board(), seen_backdrop()});
    const Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
    EXPECT_EQ(num_added(moved(scene, 1.0, turn, Vector3d::Zero())), num_added(scene));
}

} // namespace
} // namespace vcarve::border_candidates_test
