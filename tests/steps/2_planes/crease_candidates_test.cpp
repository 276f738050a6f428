#include "steps/1_points/arrange.h"
#include "steps/2_planes/added_points.h"
#include "steps/2_planes/candidates.h"
#include "support/flat_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vcarve::crease_candidates_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace flat_scenes;

/// The points that were added to a scene.
std::vector<std::size_t> added_points(const Scene& scene)
{
    return points_of_kind(scene, PointKind::crease);
}

/// Adds points only on creases.
const AddedPointOptions kOnCreases = {.border_gap = 0.0, .textureless_step = 0.0};

std::int64_t num_added(Scene scene, const AddedPointOptions& options = kOnCreases)
{
    return add_points(scene, options).added;
}

/// The distance to the nearest of some other points.
double distance_to_others(const Scene& scene, std::size_t point,
                          const std::vector<std::size_t>& points)
{
    double least = 1e9;
    for (const std::size_t other : points) {
        const double distance = (scene.positions[other] - scene.positions[point]).norm();
        if (other != point) least = std::min(least, distance);
    }
    return least;
}

TEST(CreaseCandidates, AreAddedAlongTheFootOfAWall)
{
    const Scene before = together({wall(0.35), ground(0.35)});
    Scene scene = before;
    const AddedPoints report = add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_EQ(report.regions, 2);
    EXPECT_EQ(report.added, std::ssize(added));
    EXPECT_EQ(scene.num_points(), before.num_points() + added.size());
    // The crease is 2 long, with a point every .7 estimated spacings.
    EXPECT_GE(added.size(), 20U);
    EXPECT_LE(added.size(), 40U);
    EXPECT_EQ(scene.colors.size(), scene.num_points());
    EXPECT_TRUE(scene.normals.empty());
}

TEST(CreaseCandidates, AreOnTheCreaseAndApartFromEachOther)
{
    Scene scene = together({wall(0.35), ground(0.35)});
    add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    for (const std::size_t i : added) {
        EXPECT_NEAR(scene.positions[i].y(), 1.0, 0.002 * kSpacing);
        EXPECT_NEAR(scene.positions[i].z(), 0.0, 0.002 * kSpacing);
        EXPECT_LT(std::abs(scene.positions[i].x()), 1.02);
        EXPECT_EQ(track_of(scene, i), kAll);
        EXPECT_EQ(scene.errors_px[i], 0.5);
        EXPECT_GT(distance_to_others(scene, i, added), 0.5 * kSpacing);
    }
}

TEST(CreaseCandidates, NeedPointsWithinTheReach)
{
    // The estimated spacing is .1. Both gaps are 8 spacings, or 20.
    EXPECT_GT(num_added(together({wall(0.8), ground(0.8)})), 10);
    EXPECT_EQ(num_added(together({wall(0.8), ground(0.8)}),
                        {.crease_reach = 5.0, .border_gap = 0.0, .textureless_step = 0.0}),
              0);
    const auto high = flat({-1.0, -2.0}, {1.0, -1.0}, kAll,
                           [](double u, double v) { return Vector3d(u, v, 0.0); });
    EXPECT_GT(num_added(together({high, ground(0.35)})), 10);
    EXPECT_EQ(num_added(together({high, ground(0.35)}),
                        {.crease_reach = 18.0, .border_gap = 0.0, .textureless_step = 0.0}),
              0);
    EXPECT_EQ(num_added(together({wall(0.35), ground(0.35)}),
                        {.crease_reach = 0.0, .border_gap = 0.0, .textureless_step = 0.0}),
              0);
}

TEST(CreaseCandidates, NeedPointsOfBothPlanesOnBothSides)
{
    // The floor has points only on the right, the wall only to the left of .5.
    auto right = ground(0.35);
    std::erase_if(right, [](const MadePoint& p) { return p.position.x() < -0.2; });
    auto left = wall(0.35);
    std::erase_if(left, [](const MadePoint& p) { return p.position.x() > 0.5; });
    Scene scene = together({left, right});
    add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_GT(added.size(), 4U);
    for (const std::size_t i : added) {
        EXPECT_GT(scene.positions[i].x(), -0.23);
        EXPECT_LT(scene.positions[i].x(), 0.53);
    }
}

TEST(CreaseCandidates, LeaveGapsIfOnePlaneHasNoPoints)
{
    auto floor = ground(0.35); // surrounds an area without points
    std::erase_if(floor, [](const MadePoint& p) {
        return std::abs(p.position.x()) < 0.65 && p.position.z() > -1.1;
    });
    Scene scene = together({wall(0.35), floor});
    add_points(scene, {.crease_reach = 6.0,
                       .border_gap = 0.0,
                       .textureless_step = 0.0}); // .6 along the crease, too
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_GT(added.size(), 6U);
    for (const std::size_t i : added) {
        EXPECT_GT(std::abs(scene.positions[i].x()), 0.63);
    }
}

TEST(CreaseCandidates, OfTwoNearbyCreasesAreApart)
{
    // One wall is behind the other, by less than the step of crease points.
    const auto part = [](double low, double high, double z) {
        return flat({low, -0.6}, {high, 0.65}, kAll,
                    [=](double u, double v) { return Vector3d(u, v, z); });
    };
    Scene scene = together({part(-1.0, 0.4, 0.0), part(-0.4, 1.0, 0.05), ground(0.15)});
    const AddedPoints report = add_points(scene, kOnCreases);
    EXPECT_GE(report.regions, 3);
    const std::vector<std::size_t> added = added_points(scene);
    const auto is_behind = [&](std::size_t i) { return scene.positions[i].z() > 0.01; };
    EXPECT_GT(std::ranges::count_if(added, is_behind), 4);
    EXPECT_LT(std::ranges::count_if(added, is_behind), std::ssize(added) - 4);
    for (const std::size_t i : added) {
        EXPECT_GT(distance_to_others(scene, i, added), 0.025);
    }
}

TEST(CreaseCandidates, HaveTheViewsOfAllEquallyNearPoints)
{
    // At the center the central column is nearest, followed by the columns on both sides.
    std::vector<MadePoint> points;
    for (int column = -10; column <= 10; ++column) {
        const Views views = column < 0 ? Views{0, 1} : column > 0 ? Views{1, 2} : Views{1};
        for (int row = 0; row < 12; ++row) {
            points.push_back({{0.1 * column, 0.7 - 0.1 * row, 0.0}, views});
            points.push_back({{0.1 * column, 1.0, -0.3 - 0.1 * row}, views});
        }
    }
    Scene scene = together({points});
    add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    const auto middle = std::ranges::find_if(
        added, [&](std::size_t i) { return std::abs(scene.positions[i].x()) < 0.01; });
    ASSERT_NE(middle, added.end());
    EXPECT_EQ(track_of(scene, *middle), kAll);
}

TEST(CreaseCandidates, AreNotAddedAmongPointsOfOtherObjects)
{
    // A rough hedge along the foot of the wall.
    std::mt19937 random(6);
    std::uniform_real_distribution<double> along(-1.0, 1.0);
    std::uniform_real_distribution<double> across(0.0, 0.2);
    std::vector<MadePoint> hedge;
    hedge.reserve(600);
    for (int i = 0; i < 600; ++i) {
        hedge.push_back({{along(random), 1.0 - across(random), -across(random)}, kAll});
    }
    EXPECT_LE(num_added(together({wall(0.35), ground(0.35), hedge})), 2);
}

/// Points behind the wall, near and far, that views see beneath it.
std::vector<MadePoint> beneath()
{
    return flat({-1.6, 0.5}, {1.6, 0.8}, kAll, [](double u, double v) {
        return Vector3d(u, v, 1.5 + 0.5 * std::sin(40.0 * u + 100.0 * v));
    });
}

TEST(CreaseCandidates, AreNotAddedIfRaysPassThroughTheirSurface)
{
    const auto floor = ground(0.35);
    const std::int64_t without = num_added(together({wall(0.8), floor}));
    EXPECT_GT(without, 20);
    EXPECT_EQ(num_added(together({wall(0.8), floor, beneath()})), 0);
    // Rays pass beneath the right half only.
    auto half = beneath();
    std::erase_if(half, [](const MadePoint& p) { return p.position.x() < 0.0; });
    Scene scene = together({wall(0.8), floor, half});
    add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    EXPECT_GT(std::ssize(added), without / 3);
    for (const std::size_t i : added) {
        EXPECT_LT(scene.positions[i].x(), 0.1);
    }
}

TEST(CreaseCandidates, AreAddedIfFewerRaysPassThanViewsSeeThem)
{
    const std::vector<std::vector<MadePoint>> parts = {
        wall(0.8), ground(0.35), {{{0.2, 0.6, 1.5}, {0, 1}}, {{-0.5, 0.7, 1.5}, {1, 2}}}};
    EXPECT_EQ(num_added(together(parts)), num_added(together({wall(0.8), ground(0.35)})));
}

TEST(CreaseCandidates, AreNotAddedAtSmallAngles)
{
    const auto slope = [](double degrees) {
        const double angle = degrees / 180.0 * std::acos(-1.0);
        return flat({-1.0, 0.2}, {1.0, 1.0}, kAll, [=](double u, double v) {
            return Vector3d(u, v * std::cos(angle), v * std::sin(angle));
        });
    };
    const auto upper = flat({-1.0, -1.0}, {1.0, -0.2}, kAll,
                            [](double u, double v) { return Vector3d(u, v, 0.0); });
    EXPECT_EQ(num_added(together({upper, slope(25.0)})), 0);
    EXPECT_GT(num_added(together({upper, slope(35.0)})), 10);
}

TEST(CreaseCandidates, AreNotAddedToRoundObjects)
{
    EXPECT_EQ(num_added(together({ball(4000, 0.0)})), 0);
}

TEST(CreaseCandidates, NeedViewsInFrontOfBothPlanesOfACorner)
{
    // The last view saw the wall's points, but is below the floor.
    std::vector<Vector3d> centers = kCenters;
    centers.emplace_back(0.0, 2.0, -6.0);
    Scene scene = together({wall(0.35, {0, 1, 3}), ground(0.35)}, centers);
    ASSERT_GT(add_points(scene, kOnCreases).added, 10);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), kAll);
    }
    // Only one view is in front of both.
    Scene hidden = together({wall(0.35, {2, 3}), ground(0.35, {2})}, centers);
    EXPECT_EQ(add_points(hidden, kOnCreases).added, 0);
}

TEST(CreaseCandidates, NeedViewsInFrontOfOnePlaneOfAnEdge)
{
    // The edge of a box along y; two views see each side of it.
    const std::vector<Vector3d> centers = {{-3, 0, -6}, {-3, 0.2, -6}, {3, 0, -6}, {3, 0.2, -6}};
    const auto side = [&](double slope, const Views& views) {
        return flat({-0.8, 0.2}, {0.8, 1.2}, views,
                    [=](double u, double v) { return Vector3d(slope * v, u, 3.0 * v); });
    };
    Scene scene = together({side(-1.0, {0, 1}), side(1.0, {2, 3})}, centers);
    ASSERT_GT(add_points(scene, kOnCreases).added, 5);
    const Views all = {0, 1, 2, 3};
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), all);
    }
}

TEST(CreaseCandidates, HaveOnlyViewsWhoseImagesShowThem)
{
    // The first view's image ends above the edge of the floor and shows only the wall.
    std::vector<Vector3d> centers = kCenters;
    centers[0] = {0.0, -2.2, -6.0};
    Scene scene = together({wall(0.35), ground(0.35, {1, 2})}, centers);
    ASSERT_GT(add_points(scene, kOnCreases).added, 10);
    for (const std::size_t i : added_points(scene)) {
        EXPECT_EQ(track_of(scene, i), Views({1, 2}));
    }
}

TEST(CreaseCandidates, AreNotAddedToFewPoints)
{
    for (int count = 0; count < 14; ++count) {
        std::vector<MadePoint> points(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) {
            points[i] = {{0.1 * i, 0.03 * i * i, 0.0}, kAll};
        }
        EXPECT_EQ(num_added(make_scene(kCenters, points)), 0);
    }
}

/// The maximum distance between points of one scene and the transformed points of another.
double farthest_off(const Scene& there, const Scene& here, double scale, const Vector3d& shift)
{
    double most = 0.0;
    for (std::size_t i = 0; i < here.num_points(); ++i) {
        const Vector3d place = scale * here.positions[i] + shift;
        most = std::max(most, (there.positions[i] - place).norm());
    }
    return most;
}

TEST(CreaseCandidates, DoNotDependOnUnitAndPosition)
{
    const Scene scene = together({wall(0.35), ground(0.35)});
    Scene here = scene;
    add_points(here, kOnCreases);
    for (const double scale : {1.0 / 1024.0, 1e-3, 37.3, 1e6}) {
        const Vector3d shift(3.0 * scale, -5.0 * scale, 7.0 * scale);
        Scene there = moved(scene, scale, Quaterniond::Identity(), shift);
        add_points(there, kOnCreases);
        ASSERT_EQ(there.point_ids, here.point_ids) << scale;
        EXPECT_EQ(there.tracks.views, here.tracks.views);
        EXPECT_LT(farthest_off(there, here, scale, shift), 1e-12 * scale);
    }
}

TEST(CreaseCandidates, DoNotDependOnRotation)
{
    const Scene scene = together({wall(0.35), ground(0.35)});
    const Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
    EXPECT_EQ(num_added(moved(scene, 1.0, turn, Vector3d::Zero())), num_added(scene));
}

TEST(CreaseCandidates, OfOneCreaseAreNotCoplanar)
{
    // Along a hull, rounding would decide which cells coplanar points have.
    Scene scene = together({wall(0.35), ground(0.35)});
    add_points(scene, kOnCreases);
    const std::vector<std::size_t> added = added_points(scene);
    ASSERT_GT(added.size(), 8U);
    for (std::size_t i = 0; i + 3 < added.size(); ++i) {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k) {
            edges.col(k) = scene.positions[added[i + k + 1]] - scene.positions[added[i]];
        }
        EXPECT_GT(std::abs(edges.determinant()), 1e-12 * std::pow(kSpacing, 3));
    }
}

TEST(CreaseCandidates, AreSearchedOnlyNearPoints)
{
    // The intersection of the planes between the points has room for 3e13 candidates.
    Scene scene;
    for (const double y : {-1e10, -1e10 + 0.004, 0.0, 0.004, 1e10 - 0.004, 1e10}) {
        scene.positions.emplace_back(0.0, y, 0.0);
    }
    PlanarRegions planes(scene);
    planes.spacings.assign(6, 1e-3);
    for (const Vector3d& normal : {Vector3d(1, 0, 0), Vector3d(0, 0, 1)}) {
        planes.regions.emplace_back(scene, Plane{{0, 0, 0}, normal}, 1e-3,
                                    std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    }
    const std::vector<Candidate> found = crease_candidates(scene, planes, 8.0, {});
    EXPECT_GE(found.size(), 9U);
    EXPECT_LE(found.size(), 24U);
    // Doubles would not distinguish these candidates, so the loop would not end.
    planes.spacings.assign(6, 1e-12);
    for (PlanarRegion& region : planes.regions) {
        region.spacing = 1e-12;
    }
    EXPECT_TRUE(crease_candidates(scene, planes, 8.0, {}).empty());
}

} // namespace
} // namespace vcarve::crease_candidates_test
