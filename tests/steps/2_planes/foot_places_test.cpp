#include "steps/1_points/spatial_sort.h"
#include "steps/2_planes/crease_points.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

using Views = std::vector<std::uint32_t>;

/// Four cameras that look along z, which points down here: at the roof of a house and the ground
/// z = 1 around it, and at none of its walls.
const std::vector<Vector3d> kCenters = {
    {-2.5, -1.4, -6}, {2.5, -1.4, -6}, {-2.5, 1.4, -6}, {2.5, 1.4, -6}};
const Views kAll = {0, 1, 2, 3};

/// Half of what the house is long and wide.
constexpr double kLong = 0.5;
constexpr double kWide = 0.4;
constexpr double kSpacing = 0.1;

double beyond_house(const Vector3d& place)
{
    return std::max(std::abs(place.x()) - kLong, std::abs(place.y()) - kWide);
}

/// A box as high, with its roof so far above the ground, down to a depth from the roof on: a house
/// if that is the ground, a table if it is less.
struct Roof {
    double height = 1.0;
    double depth = height;
};

/// Whether a roof hides a place of the ground from a view.
bool is_hidden(const Vector3d& place, const Vector3d& center, const Roof& roof)
{
    for (int step = 0; step <= 100; ++step) {
        const double above = roof.height - roof.depth * step / 100.0;
        const Vector3d at = place + above / (1.0 - center.z()) * (center - place);
        if (beyond_house(at) < 0.0) return true;
    }
    return false;
}

/// Points of the roof and of what is seen of the ground, but for a stretch beside the roof.
Scene scene_of(const Roof& roof)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-0.02, 0.02);
    std::vector<MadePoint> points;
    for (double x = -1.6; x <= 1.6; x += kSpacing) {
        for (double y = -1.4; y <= 1.4; y += kSpacing) {
            const Vector3d place{x + off(random), y + off(random), 1.0};
            Views views;
            for (const std::uint32_t view : kAll) {
                if (!is_hidden(place, kCenters[view], roof)) views.push_back(view);
            }
            const bool is_beside = std::abs(beyond_house(place) - kSpacing) < kSpacing;
            if (views.size() >= 2 && !is_beside) points.push_back({place, views});
            const Vector3d above(place.x(), place.y(), 1.0 - roof.height);
            if (beyond_house(above) < 0.0) points.push_back({above, kAll});
        }
    }
    return spatial_sort(make_scene(kCenters, points));
}

/// The points that were added on the ground.
std::vector<std::size_t> feet(Scene& scene)
{
    add_crease_points(scene, {});
    std::vector<std::size_t> found = flat_scenes::points_with_id(scene, kBorderPointId);
    std::erase_if(found, [&](std::size_t i) { return scene.positions[i].z() <= 0.9; });
    return found;
}

TEST(FootPoints, StandOnTheGroundNextToTheHouse)
{
    Scene scene = scene_of({});
    const std::vector<std::size_t> found = feet(scene);
    EXPECT_GT(found.size(), 8U);
    for (const std::size_t i : found) {
        const Vector3d& at = scene.positions[i];
        EXPECT_NEAR(at.z(), 1.0, 0.01 * kSpacing);
        EXPECT_GT(beyond_house(at), -0.5 * kSpacing) << "beneath the house";
        EXPECT_LT(beyond_house(at), 2.0 * kSpacing) << "away from it";
    }
}

TEST(FootPoints, AreAddedBelowAllWalls)
{
    Scene scene = scene_of({});
    std::vector<Vector3d> at;
    for (const std::size_t i : feet(scene)) {
        at.push_back(scene.positions[i]);
    }
    EXPECT_TRUE(std::ranges::any_of(at, [](const Vector3d& p) { return p.x() < -kLong; }));
    EXPECT_TRUE(std::ranges::any_of(at, [](const Vector3d& p) { return p.x() > kLong; }));
    EXPECT_TRUE(std::ranges::any_of(at, [](const Vector3d& p) { return p.y() < -kWide; }));
    EXPECT_TRUE(std::ranges::any_of(at, [](const Vector3d& p) { return p.y() > kWide; }));
}

TEST(FootPoints, AreSeenFromTheirSideOfTheWall)
{
    // So low that all views see the points next to it.
    Scene scene = scene_of({.height = 0.25});
    const std::vector<std::size_t> found = feet(scene);
    EXPECT_GT(found.size(), 8U);
    for (const std::size_t i : found) {
        const Vector3d& at = scene.positions[i];
        EXPECT_GE(scene.tracks[i].size(), 2U);
        // At a corner the way out may be that of either wall.
        if (std::abs(at.y()) > kWide - 2 * kSpacing || std::abs(at.x()) < kLong) continue;
        for (const std::uint32_t view : scene.tracks[i]) {
            EXPECT_GT(kCenters[view].x() * at.x(), 0.0);
        }
    }
}

TEST(FootPoints, AreNoneWhereOneSeesTheGroundBeneath)
{
    Scene table = scene_of({.height = 1.0, .depth = 0.02});
    EXPECT_LE(feet(table).size(), 1U);
}

TEST(FootPoints, AreNoneWithoutBorders)
{
    Scene scene = scene_of({});
    EXPECT_EQ(add_crease_points(scene, {.border_gap = 0.0, .blank_step = 0.0}).along_borders, 0);
}

} // namespace
} // namespace vcarve
