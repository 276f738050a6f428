#include "mesh/check.h"
#include "steps/1_points/crop.h"
#include "support/region_checks.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vcarve::crop_test {
namespace {

using Eigen::Vector3d;

/// Two views above the box from -1 to 1, and one inside it.
const std::vector<Vector3d> kCenters = {{0, 0, 10}, {10, 0, 10}, {0, 0, 0.5}};

std::unique_ptr<Region> unit_box()
{
    return box_region({-1, -1, -1}, {1, 1, 1});
}

TEST(Crop, KeepsAllRaysOfPointsInsideTheRegion)
{
    const Scene scene = make_scene(kCenters, {{{0, 0, 0}, {0, 1}}, {{1, 1, 1}, {0, 1, 2}}});
    const CroppedPoints cropped = crop_points(scene, *unit_box());
    EXPECT_EQ(cropped.inside, 2);
    EXPECT_EQ(cropped.witnesses, 0);
    EXPECT_EQ(cropped.scene.positions, scene.positions);
    EXPECT_EQ(cropped.scene.tracks.views, scene.tracks.views);
    EXPECT_EQ(cropped.scene.views.size(), scene.views.size());
}

TEST(Crop, KeepsRaysOfOutsidePointsThatPassThroughTheRegion)
{
    Scene scene = make_scene(kCenters, {{{0, 0, -5}, {0, 1}}, // below: view 0 looks through the box
                                        {{5, 0, 0}, {0, 1}},  // beside: no view does
                                        {{0, 0, 0}, {0, 1}},  // inside
                                        {{50, 0, 0}, {0, 2}}}); // beside: view 2 is inside the box
    scene.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
    scene.offset = {7, 8, 9};
    scene.errors_px = {0.1, 0.2, 0.3, 0.4};
    const CroppedPoints cropped = crop_points(scene, *unit_box());
    EXPECT_EQ(cropped.inside, 1);
    EXPECT_EQ(cropped.witnesses, 2);
    EXPECT_EQ(cropped.scene.point_ids, (std::vector<std::uint64_t>{1, 3, 4}));
    EXPECT_EQ(cropped.scene.tracks.begins, (std::vector<std::uint64_t>{0, 1, 3, 4}));
    EXPECT_EQ(cropped.scene.tracks.views, (std::vector<std::uint32_t>{0, 0, 1, 2}));
    EXPECT_EQ(cropped.scene.normals,
              (std::vector<Eigen::Vector3f>{{1, 0, 0}, {0, 0, 1}, {0, 0, -1}}));
    EXPECT_EQ(cropped.scene.errors_px, (std::vector<double>{0.1, 0.3, 0.4}));
    EXPECT_EQ(cropped.scene.colors[2], scene.colors[3]);
    EXPECT_EQ(cropped.scene.offset, scene.offset);
}

TEST(Crop, RejectsARegionWithoutPoints)
{
    Scene scene = make_scene(kCenters, {{{0, 0, -5}, {0, 1}}, {{5, 2, 0.25}, {0, 1}}});
    scene.offset = {100, 0, 0};
    EXPECT_EQ(refusal<InputError>([&] { crop_points(scene, *unit_box()); }),
              "no point is inside the region of --crop (x 99 to 101, y -1 to 1, z -1 to 1); the "
              "points span x 100 to 105, y 0 to 2, z -5 to 0.25. Enlarge or move the region");
}

TEST(Crop, AcceptsASceneWithoutPoints)
{
    const CroppedPoints cropped = crop_points(make_scene(kCenters, {}), *unit_box());
    EXPECT_EQ(cropped.scene.num_points(), 0U);
}

TEST(Crop, ReturnsTheSamePointsForAnyThreadCount)
{
    const Scene scene = bumpy_sphere(3000, 4);
    const auto region = box_region({0, -0.5, -0.5}, {2, 0.5, 0.5});
    tbb::task_arena one(1);
    const Scene alone = one.execute([&] { return crop_points(scene, *region).scene; });
    const Scene together = crop_points(scene, *region).scene;
    EXPECT_EQ(alone.point_ids, together.point_ids);
    EXPECT_EQ(alone.tracks.begins, together.tracks.begins);
    EXPECT_EQ(alone.tracks.views, together.tracks.views);
    EXPECT_LT(alone.num_points(), scene.num_points());
}

Reconstruction run(const Scene& scene, const RegionChoice& region, Options options = {})
{
    Log silent;
    options.crop.region = region;
    return reconstruct(scene, options, silent);
}

RegionChoice box(const Vector3d& low, const Vector3d& high)
{
    return {.kind = RegionChoice::Kind::box, .low = low, .high = high};
}

/// An octahedron whose corners are seen from outside by two views each, and a point seen by two
/// views on the opposite side.
Scene octahedron_and(const Vector3d& far_point)
{
    std::vector<Vector3d> centers;
    std::vector<MadePoint> points;
    for (const double side : {1.0, -1.0}) {
        for (int axis = 0; axis < 3; ++axis) {
            const Vector3d corner = side * Vector3d::Unit(axis);
            points.push_back({corner, {}});
            for (const double aside : {-0.3, 0.3}) {
                points.back().views.push_back(static_cast<std::uint32_t>(centers.size()));
                centers.emplace_back(5.0 * corner + aside * Vector3d::Unit((axis + 1) % 3));
            }
        }
    }
    points.push_back({far_point, {}});
    for (const double aside : {-0.3, 0.3}) {
        points.back().views.push_back(static_cast<std::uint32_t>(centers.size()));
        centers.emplace_back(far_point.x() + aside, far_point.y(), -far_point.z());
    }
    return make_scene(centers, points);
}

/// The number of faces inside the octahedron: faces with two opposite corners of it.
std::int64_t faces_within_octahedron(const TriMesh& mesh)
{
    const auto is_within = [&](const Face& face) {
        for (int i = 0; i < 3; ++i) {
            const Vector3d a = mesh.positions[face[i]] + mesh.offset;
            const Vector3d b = mesh.positions[face[(i + 1) % 3]] + mesh.offset;
            if ((a + b).norm() < 1e-9) return true;
        }
        return false;
    };
    return std::ranges::count_if(mesh.faces, is_within);
}

TEST(Crop, CarvesWithRaysThatPassThroughTheRegion)
{
    const RegionChoice region = box({-2, -2, -2}, {2, 2, 2});
    Options options;
    options.labels.method = Method::strict;
    options.surface.closed = true;
    const Reconstruction carved = run(octahedron_and({0.2, 0.3, -6}), region, options);
    EXPECT_EQ(carved.scene.num_points(), 7U);
    EXPECT_GT(faces_within_octahedron(carved.mesh), 0);

    const Reconstruction whole = run(octahedron_and({9, 9, -6}), region, options);
    EXPECT_EQ(whole.scene.num_points(), 6U);
    EXPECT_EQ(whole.mesh.faces.size(), 8U);
    EXPECT_EQ(faces_within_octahedron(whole.mesh), 0);
}

TEST(Crop, KeepsNoFaceWithACornerOutsideTheRegion)
{
    const Scene scene = bumpy_sphere(3000, 4);
    const RegionChoice half = box({0, -2, -2}, {2, 2, 2});
    for (const bool closed : {false, true}) {
        Options options;
        options.surface.closed = closed;
        options.surface.cleanup.max_hole = 0;
        const Reconstruction cropped = run(scene, half, options);
        const MeshCheck check = check_mesh(cropped.mesh);
        EXPECT_GT(check.boundary_edges, 20);
        EXPECT_GT(check.faces, 2000);
        for (const Vector3d& position : cropped.mesh.positions) {
            ASSERT_GE(position.x() + cropped.mesh.offset.x(), 0.0);
        }
    }
}

TEST(Crop, ChangesNothingIfTheRegionContainsAll)
{
    const Scene scene = bumpy_sphere(3000, 4);
    const TriMesh all = run(scene, {}).mesh;
    const TriMesh cropped = run(scene, box({-99, -99, -99}, {99, 99, 99})).mesh;
    EXPECT_EQ(cropped.positions, all.positions);
    EXPECT_EQ(cropped.faces, all.faces);
    EXPECT_EQ(cropped.points, all.points);
}

TEST(Crop, ReturnsTheSameSurfaceForAnyThreadCount)
{
    const Scene scene = bumpy_sphere(3000, 4);
    Options one;
    one.threads = 1;
    Options two;
    two.threads = 2;
    const RegionChoice looked_at = {.kind = RegionChoice::Kind::looked_at};
    const TriMesh a = run(scene, looked_at, one).mesh;
    const TriMesh b = run(scene, looked_at, two).mesh;
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.faces, b.faces);
}

TEST(Crop, AppliesTheRegionInTheModelsCoordinates)
{
    const Scene scene = bumpy_sphere(3000, 4);
    const Vector3d utm(500000, 4600000, 100);
    const Scene far = moved(scene, 1.0, Eigen::Quaterniond::Identity(), utm);
    const RegionChoice here = box({0, -2, -2}, {2, 2, 2});
    const TriMesh near = run(scene, here).mesh;
    EXPECT_EQ(run(far, box(here.low + utm, here.high + utm)).mesh.faces, near.faces);
}

TEST(Crop, RejectsARegionWithoutAFace)
{
    const Scene scene = bumpy_sphere(3000, 4);
    double farthest = 0.0;
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        if (scene.tracks[point].size() > 1) {
            farthest = std::max(farthest, scene.positions[point].x());
        }
    }
    EXPECT_EQ(refusal<InputError>([&] {
                  run(scene, box({farthest, -9, -9}, {99, 9, 9}));
              }),
              "the region of --crop contains no face of the surface; enlarge it");
}

} // namespace
} // namespace vcarve::crop_test
