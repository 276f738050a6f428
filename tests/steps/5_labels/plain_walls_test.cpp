#include "geometry/triangle.h"
#include "steps/5_labels/boundary.h"
#include "steps/5_labels/plain_walls.h"
#include "support/made_cells.h"
#include "support/scenes.h"
#include "vcarve/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vcarve::plain_walls_test {
namespace {

using Eigen::Vector3d;

constexpr double kWidth = 4.0;  // width and depth of the room
constexpr double kHeight = 2.5; // z is up

/// Changes to a room whose wall at x = kWidth has points only along its outline.
struct Changes {
    int num_views = 4;                    ///< looking at the wall
    double bulge = 0.0;                   ///< distance of the middle of its top from the plane
    bool has_few_points = false;          ///< only at the corners of the wall
    bool has_walls_beside = true;         ///< otherwise only the floor adjoins the wall
    Vector3d up = Vector3d::UnitZ();      ///< of the images
    Vector3d towards = Vector3d::UnitX(); ///< viewing direction
};

/// Grids of points on the floor and on three walls, and points along the outline of the fourth.
struct Room {
    explicit Room(const Changes& changes = {})
    {
        std::vector<Vector3d> centers;
        std::vector<std::uint32_t> all;
        for (int i = 0; i < changes.num_views; ++i) {
            centers.emplace_back(2.0 + 0.1 * i, 1.5 + 0.3 * i, 1.2);
            all.push_back(static_cast<std::uint32_t>(i));
        }
        scene = make_scene(centers, {});
        Eigen::Matrix3d cam_from_world;
        cam_from_world << changes.towards.cross(changes.up).transpose(), -changes.up.transpose(),
            changes.towards.transpose();
        for (View& view : scene.views) {
            view.cam_from_world = Eigen::Quaterniond(cam_from_world);
        }
        constexpr double kStep = 0.25;
        for (double u = 0.0; u <= kWidth; u += kStep) {
            for (double v = 0.0; v <= kWidth; v += kStep) {
                const bool is_inner = u < kWidth;
                if (is_inner) add({u, v, 0.0}, all);
                if (v > kHeight) continue;
                add({0.0, u, v}, all);
                if (changes.has_walls_beside && is_inner) add({u, 0.0, v}, all);
                if (changes.has_walls_beside && is_inner) add({u, kWidth, v}, all);
                const bool at_side = u == 0.0 || u == kWidth;
                const bool at_end = v == 0.0 || v == kHeight;
                if (changes.has_few_points ? !(at_side && at_end) : !(at_side || at_end)) continue;
                if (std::fmod(u, 0.5) > 0.0 || std::fmod(v, 0.5) > 0.0) continue;
                const bool is_top = u == kWidth / 2 && v == kHeight;
                add({kWidth + (is_top ? changes.bulge : 0.0), u, v}, all);
            }
        }
        mesh = triangulate(scene);
        labels.assign(mesh.cells.size(), Label::outside);
        for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
            if (!mesh.cells[cell].is_infinite()) continue;
            const Face face = face_of(mesh, {cell, kHullSlot});
            const Vector3d inwards = face_normal(mesh.positions, face);
            if (inwards.x() < -0.9) {
                open.push_back(cell);
            } else if (inwards.x() > 0.9 || inwards.z() > 0.9 ||
                       (changes.has_walls_beside && std::abs(inwards.y()) > 0.9)) {
                labels[cell] = Label::inside;
            }
        }
    }

    void add(const Vector3d& place, const std::vector<std::uint32_t>& views)
    {
        if (std::ranges::count(scene.positions, place) > 0) return;
        scene.positions.push_back(place);
        scene.colors.push_back({});
        scene.errors_px.push_back(0.5);
        scene.point_ids.push_back(scene.num_points());
        scene.tracks.push_back(views);
    }

    /// The area of the walls that are found.
    double area() const
    {
        double sum = 0.0;
        for (const Index cell : plain_walls(mesh, scene, open, labels)) {
            sum += face_area(mesh.positions, face_of(mesh, {cell, kHullSlot}));
        }
        return sum;
    }

    Scene scene;
    TetMesh mesh;
    Labels labels;
    std::vector<Index> open;
};

TEST(PlainWalls, FindsAWallWithPointsOnlyAlongItsOutline)
{
    EXPECT_NEAR(Room().area(), kWidth * kHeight, 1e-9);
}

TEST(PlainWalls, AcceptsSlightlyUnevenWalls)
{
    EXPECT_GT(Room({.bulge = 0.03}).area(), 0.8 * kWidth * kHeight);
    EXPECT_LT(Room({.bulge = 0.3}).area(), 0.2 * kWidth * kHeight);
}

TEST(PlainWalls, RequiresSixPointsInThePlane)
{
    EXPECT_EQ(Room({.has_few_points = true}).area(), 0.0);
}

TEST(PlainWalls, RequiresFacesAlongTheOutline)
{
    EXPECT_EQ(Room({.has_walls_beside = false}).area(), 0.0) << "the foot is 4 of 13";
}

TEST(PlainWalls, RequiresThreeViews)
{
    EXPECT_GT(Room({.num_views = 3}).area(), 0.0);
    EXPECT_EQ(Room({.num_views = 2}).area(), 0.0);
    EXPECT_EQ(Room({.towards = -Vector3d::UnitX()}).area(), 0.0) << "the views look away";
}

TEST(PlainWalls, RejectsCeilings)
{
    // For views that look down by 45 degrees, the wall is between upright and level.
    EXPECT_EQ(
        Room({.up = Vector3d(1, 0, 1).normalized(), .towards = Vector3d(1, 0, -1).normalized()})
            .area(),
        0.0);
    // The wall is upright in images that are rotated by 45 degrees.
    EXPECT_GT(Room({.up = Vector3d(0, 1, 1).normalized()}).area(), 0.0);
}

TEST(PlainWalls, AddsTheWallToTheMesh)
{
    Log log;
    const Room room;
    const TriMesh mesh = reconstruct(room.scene, {}, log).mesh;
    double area = 0.0;
    for (const Face& face : mesh.faces) {
        if (face_normal(mesh.positions, face).x() < -0.99) area += face_area(mesh.positions, face);
    }
    EXPECT_NEAR(area, kWidth * kHeight, 0.01 * kWidth * kHeight);
}

TEST(PlainWalls, DoesNotDependOnTheThreadCount)
{
    const Room room;
    const auto found = [&] { return plain_walls(room.mesh, room.scene, room.open, room.labels); };
    EXPECT_EQ(testing::with_threads(1, found), testing::with_threads(4, found));
}

} // namespace
} // namespace vcarve::plain_walls_test
