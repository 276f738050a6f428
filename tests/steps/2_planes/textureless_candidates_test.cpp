#include "steps/2_planes/added_points.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vcarve::textureless_candidates_test {
namespace {

using Eigen::Vector3d;
using flat_scenes::flat;
using flat_scenes::kAll;
using flat_scenes::kCenters;
using flat_scenes::kSpacing;
using flat_scenes::points_of_kind;
using flat_scenes::together;
using flat_scenes::track_of;

/// Adds points only in textureless areas.
const AddedPointOptions kTextureless = {.crease_reach = 0.0, .border_gap = 0.0};

/// A position on or above a floor that rises away from the views at 45 degrees: `right` and `near`
/// are along the floor, `high` is over it.
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

/// The larger of the distances from the floor's center along its two directions.
double off_middle(const Vector3d& place)
{
    return std::max(std::abs(place.x()), std::abs(near(place)));
}

/// A rectangle of the floor.
std::vector<MadePoint> level(const Eigen::Array2d& low, const Eigen::Array2d& high)
{
    return flat(low, high, kAll, [&](double u, double v) { return on_floor(u, v); });
}

/// The floor, without points within `gap` of its center.
std::vector<MadePoint> floor_with_gap(double gap = 0.5, double half = 1.2)
{
    std::vector<MadePoint> points = level({-half, -half}, {half, half});
    std::erase_if(points, [&](const MadePoint& point) { return off_middle(point.position) < gap; });
    return points;
}

std::vector<std::size_t> added_points(const Scene& scene)
{
    return points_of_kind(scene, PointKind::textureless);
}

std::int64_t num_added(Scene scene, const AddedPointOptions& options = kTextureless)
{
    return add_points(scene, options).added;
}

/// A scene and the points added to it, at least ten.
Scene filled(Scene scene)
{
    EXPECT_GE(add_points(scene, kTextureless).added, 10);
    return scene;
}

TEST(TexturelessCandidates, AreAddedInATexturelessPartOfAFloor)
{
    const Scene before = together({floor_with_gap()});
    Scene scene = before;
    const AddedPoints report = add_points(scene, kTextureless);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_EQ(report.added, std::ssize(added));
    EXPECT_EQ(scene.num_points(), before.num_points() + added.size());
    // About one for each empty square of two spacings, of an area of 1.
    EXPECT_GE(added.size(), 10U);
    EXPECT_LE(added.size(), 25U);
}

TEST(TexturelessCandidates, AreOnTheFloorInsideTheArea)
{
    const Scene scene = filled(together({floor_with_gap()}));
    for (const std::size_t i : added_points(scene)) {
        EXPECT_NEAR(height(scene.positions[i]), 0.0, 0.01 * kSpacing);
        EXPECT_LT(off_middle(scene.positions[i]), 0.5);
        EXPECT_EQ(track_of(scene, i), kAll);
        EXPECT_EQ(scene.errors_px[i], 0.5);
    }
}

TEST(TexturelessCandidates, HaveTheMeanColorOfTheFourNearestPoints)
{
    Scene before = together({floor_with_gap()});
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

TEST(TexturelessCandidates, AreNotAddedNextToAPointOfAnotherObject)
{
    const std::vector<MadePoint> floor = floor_with_gap();
    Scene scene = together({floor});
    add_points(scene, kTextureless);
    const Vector3d there = scene.positions[added_points(scene).front()];
    const double step = kTextureless.textureless_step * kSpacing;
    for (const double beside : {0.2, 0.8}) {
        const Vector3d thing = there + on_floor(0.0, 0.0, beside * step);
        Scene with_thing = together({floor, {{thing, {0}}}}); // the other views see the floor there
        add_points(with_thing, kTextureless);
        const auto is_there = [&](std::size_t i) {
            return (with_thing.positions[i] - there).norm() < 0.05 * step;
        };
        EXPECT_EQ(std::ranges::any_of(added_points(with_thing), is_there), beside > 0.5) << beside;
    }
}

TEST(TexturelessCandidates, AreTheStepApart)
{
    const Scene scene = together({floor_with_gap(0.5)});
    const auto with_step = [&](double step) {
        return num_added(scene, {.crease_reach = 0.0, .border_gap = 0.0, .textureless_step = step});
    };
    EXPECT_EQ(with_step(0.0), 0);
    EXPECT_GT(with_step(1.0), 3 * with_step(2.0));
    EXPECT_GT(with_step(2.0), 2 * with_step(4.0));
    EXPECT_GT(with_step(4.0), 0);
}

TEST(TexturelessCandidates, AreNotAddedAmongPoints)
{
    EXPECT_EQ(num_added(together({floor_with_gap(0.0)})), 0);
}

TEST(TexturelessCandidates, AreInsideTheHull)
{
    // A floor without its right corner, which is as empty as a gap in the center.
    std::vector<MadePoint> points = level({-1, -1}, {1, 1});
    std::erase_if(points, [](const MadePoint& point) {
        return point.position.x() + near(point.position) > 0.0;
    });
    EXPECT_LE(num_added(together({points})), 1);
}

TEST(TexturelessCandidates, NeedARegionOf100Points)
{
    std::vector<MadePoint> points = floor_with_gap(0.3, 1.0);
    std::ranges::sort(points, {},
                      [](const MadePoint& point) { return off_middle(point.position); });
    points.resize(100);
    EXPECT_GT(num_added(together({points})), 0);
    points.resize(99);
    EXPECT_EQ(num_added(together({points})), 0);
}

TEST(TexturelessCandidates, AreNotAddedIfRaysPassThroughTheirSurface)
{
    // The views see points far below the floor through the gap.
    std::vector<MadePoint> below;
    for (double u = -0.6; u < 0.6; u += 0.05) {
        for (double v = -0.6; v < 0.6; v += 0.05) {
            below.push_back({{1.4 * u, 1.4 * v, 2.0 + 0.3 * std::sin(40.0 * u + 100.0 * v)}, kAll});
        }
    }
    EXPECT_GE(num_added(together({floor_with_gap()})), 10);
    EXPECT_EQ(num_added(together({floor_with_gap(), below})), 0);
}

TEST(TexturelessCandidates, HaveTheViewsOfPointsBesideThem)
{
    // The last view saw only the far end of the floor.
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.3, 0.2, -6.0);
    std::vector<MadePoint> points = floor_with_gap();
    for (MadePoint& point : points) {
        if (near(point.position) < -0.8) point.views.push_back(3);
    }
    Scene scene = together({points}, centers);
    ASSERT_GE(add_points(scene, kTextureless).added, 10);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), kAll);
    }
}

TEST(TexturelessCandidates, NeedTwoViews)
{
    std::vector<MadePoint> points = floor_with_gap();
    for (MadePoint& point : points) {
        point.views = {1};
    }
    EXPECT_EQ(num_added(together({points})), 0);
}

TEST(TexturelessCandidates, DoNotDependOnUnitAndPosition)
{
    flat_scenes::expect_same_elsewhere(together({floor_with_gap(0.5)}), kTextureless,
                                       PointKind::textureless, {1.0, 1.0 / 1024.0, 37.3, 1e6},
                                       1e-6 * kSpacing);
}

} // namespace
} // namespace vcarve::textureless_candidates_test
