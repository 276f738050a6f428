#include "steps/2_planes/crease_points.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using flat_scenes::flat;
using flat_scenes::kAll;
using flat_scenes::kCenters;
using flat_scenes::kSpacing;
using flat_scenes::points_with_id;
using flat_scenes::together;
using flat_scenes::track_of;
using flat_scenes::Views;

/// None on creases and borders.
const CreaseOptions kInBlanks = {.reach = 0.0, .border_gap = 0.0};

/// A place so far to the right on a floor that goes up away from the views at 45 degrees, so far
/// along it, towards them, and so high over it.
Vector3d on_floor(double right, double near, double high = 0.0)
{
    const Vector3d along(0, std::sqrt(0.5), -std::sqrt(0.5));
    const Vector3d up(0, -std::sqrt(0.5), -std::sqrt(0.5));
    return {right, (near * along + high * up).y(), (near * along + high * up).z()};
}

double height(const Vector3d& place)
{
    return on_floor(0, 0, 1).dot(place);
}

double near(const Vector3d& place)
{
    return on_floor(0, 1).dot(place);
}

/// The larger of how far a place of the floor is to the side of its middle and along it.
double off_middle(const Vector3d& place)
{
    return std::max(std::abs(place.x()), std::abs(near(place)));
}

/// A rectangle so high over the floor.
std::vector<MadePoint> level(const Eigen::Array2d& low, const Eigen::Array2d& high, double above,
                             const Views& views = kAll)
{
    return flat(low, high, views, [&](double u, double v) { return on_floor(u, v, above); });
}

/// The floor, blank so far around its middle.
std::vector<MadePoint> floor_with_blank(double blank = 0.5, double half = 1.2)
{
    std::vector<MadePoint> points = level({-half, -half}, {half, half}, 0.0);
    std::erase_if(points,
                  [&](const MadePoint& point) { return off_middle(point.position) < blank; });
    return points;
}

std::vector<std::size_t> added_points(const Scene& scene)
{
    return points_with_id(scene, kBlankPointId);
}

std::int64_t num_added(Scene scene, const CreaseOptions& options = kInBlanks)
{
    return add_crease_points(scene, options).in_blanks;
}

/// A scene with the points of its blanks, of which there must be some.
Scene filled(Scene scene)
{
    EXPECT_GE(add_crease_points(scene, kInBlanks).in_blanks, 10);
    return scene;
}

TEST(BlankPoints, AreAddedWhereAFloorIsBlank)
{
    const Scene before = together({floor_with_blank()});
    Scene scene = before;
    const CreaseReport report = add_crease_points(scene, kInBlanks);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_EQ(report.in_blanks, std::ssize(added));
    EXPECT_EQ(report.added, std::ssize(added));
    EXPECT_EQ(scene.num_points(), before.num_points() + added.size());
    // One for each square of two spacings, about, of an area of 1, but for those with a point.
    EXPECT_GE(added.size(), 10U);
    EXPECT_LE(added.size(), 25U);
}

TEST(BlankPoints, StandOnTheFloorAmidTheBlank)
{
    const Scene scene = filled(together({floor_with_blank()}));
    for (const std::size_t i : added_points(scene)) {
        EXPECT_NEAR(height(scene.positions[i]), 0.0, 0.01 * kSpacing);
        EXPECT_LT(off_middle(scene.positions[i]), 0.5);
        EXPECT_EQ(track_of(scene, i), kAll);
        EXPECT_EQ(scene.errors_px[i], 0.5);
    }
}

TEST(BlankPoints, HaveTheMeanColourOfTheFourPointsNext)
{
    Scene before = together({floor_with_blank()});
    for (std::size_t i = 0; i < before.num_points(); ++i) {
        const auto value = static_cast<std::uint8_t>(37 * i % 251);
        before.colors[i] = {value, static_cast<std::uint8_t>(255 - value), 9};
    }
    const Scene scene = filled(before);
    for (const std::size_t i : added_points(scene)) {
        std::vector<std::pair<double, std::size_t>> others;
        for (std::size_t other = 0; other < before.num_points(); ++other) {
            others.emplace_back((before.positions[other] - scene.positions[i]).norm(), other);
        }
        std::ranges::sort(others);
        double red = 0.0;
        for (const auto& [distance, other] : std::span(others).first<4>()) {
            red += before.colors[other][0] / 4.0;
        }
        EXPECT_EQ(scene.colors[i][0], std::round(red));
        EXPECT_NEAR(scene.colors[i][1], 255.0 - red, 0.5);
        EXPECT_EQ(scene.colors[i][2], 9);
    }
}

TEST(BlankPoints, AreNoneNextToAPointOfAnythingElse)
{
    const std::vector<MadePoint> floor = floor_with_blank();
    Scene scene = together({floor});
    add_crease_points(scene, kInBlanks);
    const Vector3d there = scene.positions[added_points(scene).front()];
    const double step = kInBlanks.blank_step * kSpacing;
    for (const double beside : {0.2, 0.8}) {
        const Vector3d thing = there + on_floor(0.0, 0.0, beside * step);
        Scene with_thing = together({floor, {{thing, {0}}}}); // the other views see the floor there
        add_crease_points(with_thing, kInBlanks);
        const auto is_there = [&](std::size_t i) {
            return (with_thing.positions[i] - there).norm() < 0.05 * step;
        };
        EXPECT_EQ(std::ranges::any_of(added_points(with_thing), is_there), beside > 0.5) << beside;
    }
}

TEST(BlankPoints, StandSoManySpacingsApart)
{
    const Scene scene = together({floor_with_blank(0.5)});
    const auto with_step = [&](double step) {
        return num_added(scene, {.reach = 0.0, .border_gap = 0.0, .blank_step = step});
    };
    EXPECT_EQ(with_step(0.0), 0);
    EXPECT_GT(with_step(1.0), 3 * with_step(2.0));
    EXPECT_GT(with_step(2.0), 2 * with_step(4.0));
    EXPECT_GT(with_step(4.0), 0);
}

TEST(BlankPoints, AreNoneWhereAFloorHasPoints)
{
    EXPECT_EQ(num_added(together({floor_with_blank(0.0)})), 0);
}

TEST(BlankPoints, AreNoneBeyondTheHull)
{
    // A floor without its corner at the right, which is no less blank than the middle would be.
    std::vector<MadePoint> points = level({-1, -1}, {1, 1}, 0.0);
    std::erase_if(points, [](const MadePoint& point) {
        return point.position.x() + near(point.position) > 0.0;
    });
    EXPECT_LE(num_added(together({points})), 1);
}

TEST(BlankPoints, NeedAFlatPartOf100Points)
{
    std::vector<MadePoint> points = floor_with_blank(0.3, 1.0);
    std::ranges::sort(points, {},
                      [](const MadePoint& point) { return off_middle(point.position); });
    points.resize(100);
    EXPECT_GT(num_added(together({points})), 0);
    points.resize(99);
    EXPECT_EQ(num_added(together({points})), 0);
}

TEST(BlankPoints, AreNoneWhereOneLooksThrough)
{
    // Through the blank the views see what lies far below the floor.
    std::vector<MadePoint> below;
    for (double u = -0.6; u < 0.6; u += 0.05) {
        for (double v = -0.6; v < 0.6; v += 0.05) {
            below.push_back({{1.4 * u, 1.4 * v, 2.0 + 0.3 * std::sin(40.0 * u + 100.0 * v)}, kAll});
        }
    }
    EXPECT_GE(num_added(together({floor_with_blank()})), 10);
    EXPECT_EQ(num_added(together({floor_with_blank(), below})), 0);
}

TEST(BlankPoints, HangTogetherWithTheFloor)
{
    // One looks through all around the middle of the blank, along the border of which the floor
    // has points of its own.
    std::vector<MadePoint> below;
    for (double u = -0.8; u < 0.8; u += 0.03) {
        for (double v = -0.8; v < 0.8; v += 0.03) {
            const Vector3d at = on_floor(u, v);
            if (off_middle(at) > 0.75 || off_middle(at) < 0.35) continue;
            below.push_back({at + 0.3 * (at - kCenters[1]), {1}});
            below.back().position.z() += 0.1 * std::sin(40.0 * u + 100.0 * v);
        }
    }
    const Scene blank = together({floor_with_blank(0.7, 1.2)});
    const auto is_amid = [](const Scene& scene, std::size_t i) {
        return off_middle(scene.positions[i]) < 0.3;
    };
    Scene whole = blank;
    add_crease_points(whole, kInBlanks);
    EXPECT_TRUE(
        std::ranges::any_of(added_points(whole), [&](std::size_t i) { return is_amid(whole, i); }));
    Scene cut = together({floor_with_blank(0.7, 1.2), below});
    add_crease_points(cut, kInBlanks);
    EXPECT_TRUE(
        std::ranges::none_of(added_points(cut), [&](std::size_t i) { return is_amid(cut, i); }));
}

TEST(BlankPoints, AreNoneWhereAThingHidesTheFloor)
{
    // The upper edge of a thing without other points, so high that it hides what is blank.
    std::vector<MadePoint> edge;
    for (double u = -0.5; u <= 0.5; u += 0.07) {
        edge.push_back({on_floor(u, 0.4 + 0.04 * std::sin(30.0 * u), 0.75), kAll});
    }
    EXPECT_GE(num_added(together({floor_with_blank()})), 10);
    EXPECT_LE(num_added(together({floor_with_blank(), edge})), 5);
    // No higher than the floor it hides nothing.
    for (MadePoint& point : edge) {
        point.position = on_floor(point.position.x(), -0.52);
    }
    EXPECT_GE(num_added(together({floor_with_blank(), edge})), 10);
}

TEST(BlankPoints, AreNoneWhereAnotherThingIsShownNext)
{
    // A cable before the floor, in the image right across the blank. What the views show below the
    // cable is hidden by it for all they know, and of what they show above it it is the nearest.
    std::vector<MadePoint> cable;
    for (double u = -0.6; u <= 0.6; u += 0.04) {
        const Vector3d at = on_floor(u, 0.0);
        const double share = 0.95 + 0.02 * std::sin(50.0 * u);
        cable.push_back({kCenters[1] + share * (at - kCenters[1]), {1}});
    }
    const auto num_beside = [&](const std::vector<MadePoint>& thing) {
        Scene scene = together({floor_with_blank(), thing});
        add_crease_points(scene, kInBlanks);
        std::ptrdiff_t found = 0;
        for (const std::size_t i : added_points(scene)) {
            const Views track = track_of(scene, i);
            const bool is_near = near(scene.positions[i]) > -0.2 && near(scene.positions[i]) < 0.0;
            if (is_near) found += std::ranges::count(track, 1U);
        }
        return found;
    };
    EXPECT_GE(num_beside({}), 3);
    EXPECT_EQ(num_beside(cable), 0);
}

/// A roof over all of the blank, so high that images show it elsewhere.
std::vector<MadePoint> roof(double above)
{
    return level({-0.6, -0.6}, {0.6, 0.6}, above);
}

TEST(BlankPoints, AreNoneBelowARoof)
{
    EXPECT_EQ(num_added(together({floor_with_blank(), roof(2.0)})), 0);
}

TEST(BlankPoints, AreAddedBelowACeiling)
{
    // Higher than the views, which look at it from below.
    ASSERT_LT(height(kCenters[0]), 5.0);
    EXPECT_GE(num_added(together({floor_with_blank(), roof(5.0)})), 10);
}

TEST(BlankPoints, AreSeenByWhoSawThePointsBesideThem)
{
    // The last view saw nothing but the farther end of the floor.
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.3, 0.2, -6.0);
    std::vector<MadePoint> points = floor_with_blank();
    for (MadePoint& point : points) {
        if (near(point.position) < -0.8) point.views.push_back(3);
    }
    Scene scene = together({points}, centers);
    ASSERT_GE(add_crease_points(scene, kInBlanks).in_blanks, 10);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), kAll);
    }
}

TEST(BlankPoints, NeedTwoViews)
{
    std::vector<MadePoint> points = floor_with_blank();
    for (MadePoint& point : points) {
        point.views = {1};
    }
    EXPECT_EQ(num_added(together({points})), 0);
}

TEST(BlankPoints, AreTheSameInOtherUnitsAndElsewhere)
{
    flat_scenes::expect_same_elsewhere(together({floor_with_blank(0.5)}), kInBlanks, kBlankPointId,
                                       {1.0, 1.0 / 1024.0, 37.3, 1e6}, 1e-6 * kSpacing);
}

TEST(BlankPoints, AreTheSameForAnyNumberOfThreads)
{
    Scene several = together({floor_with_blank(0.5)});
    Scene one = several;
    add_crease_points(several, kInBlanks);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    add_crease_points(one, kInBlanks);
    EXPECT_EQ(one.positions, several.positions);
    EXPECT_EQ(one.tracks.views, several.tracks.views);
    EXPECT_EQ(one.point_ids, several.point_ids);
}

} // namespace
} // namespace vcarve
