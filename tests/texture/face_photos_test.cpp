#include "mesh/edge_table.h"
#include "support/photographed_wall.h"
#include "texture/face_photos.h"

#include <gtest/gtest.h>

namespace vcarve::face_photos_test {
namespace {

/// Adds a rectangle in front of the wall that hides a part of it. It faces -z.
void add_screen(TriMesh& mesh, double left, double right, double z)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{left, -0.6, z}, {right, -0.6, z}, {left, 0.6, z}, {right, 0.6, z}});
    mesh.faces.push_back({first, first + 2, first + 1});
    mesh.faces.push_back({first + 1, first + 2, first + 3});
}

TEST(PhotosOfFaces, AreSortedByDecreasingArea)
{
    TriMesh mesh = wall_mesh(2);
    const std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -4}), photo_from({0, 0, -2})};
    const auto found = find_photos_of_faces(mesh, photos, {});
    ASSERT_EQ(found.size(), mesh.faces.size());
    for (std::size_t face = 0; face < found.size(); ++face) {
        ASSERT_EQ(found[face].count, 2) << face;
        EXPECT_EQ(found[face].best[0].photo, 1U);
        EXPECT_NEAR(found[face].best[0].area_px2, 4.0 * found[face].best[1].area_px2, 1e-2);
    }
}

TEST(PhotosOfFaces, ExcludeViewsFromBehind)
{
    TriMesh mesh = wall_mesh(2);
    CalibratedPhoto behind = photo_from({0, 0, 3});
    behind.pose.cam_from_world = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
    const auto found = find_photos_of_faces(mesh, {behind}, {});
    for (const PhotosOfFace& photos : found) {
        EXPECT_EQ(photos.count, 0);
    }
}

TEST(PhotosOfFaces, ExcludeViewsBehindAnOccluder)
{
    TriMesh mesh = wall_mesh(8);
    add_screen(mesh, -0.6, 0.6, -1.0);
    const std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -3})};
    const auto found = find_photos_of_faces(mesh, photos, {});
    std::size_t shown = 0;
    for (std::size_t face = 0; face < found.size(); ++face) {
        const Eigen::Vector3d middle =
            (mesh.positions[mesh.faces[face][0]] + mesh.positions[mesh.faces[face][1]] +
             mesh.positions[mesh.faces[face][2]]) /
            3.0;
        if (middle.z() > -0.5 && middle.head<2>().lpNorm<Eigen::Infinity>() < 0.85) {
            EXPECT_EQ(found[face].count, 0) << middle.transpose();
        }
        shown += found[face].count;
    }
    EXPECT_GT(shown, 0U);
}

TEST(PhotosOfFaces, BisectPartlyHiddenFaces)
{
    TriMesh mesh = wall_mesh(1);
    add_screen(mesh, -0.2, 1.2, -0.5);
    const std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -3})};
    const double before = 4.0;
    const auto found = find_photos_of_faces(mesh, photos, {});
    ASSERT_EQ(found.size(), mesh.faces.size());
    double shown = 0.0;
    double wall = 0.0;
    for (std::size_t face = 0; face < found.size(); ++face) {
        const auto& [a, b, c] = mesh.faces[face];
        const Eigen::Vector3d& at = mesh.positions[a];
        if (at.z() < -0.1) continue;
        const double area = 0.5 * (mesh.positions[b] - at).cross(mesh.positions[c] - at).norm();
        wall += area;
        if (found[face].count > 0) shown += area;
    }
    EXPECT_NEAR(wall, before, 1e-9);
    EXPECT_GT(shown, 0.7 * (before - 1.24 * 1.44)); // the screen's shadow on the wall
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        EXPECT_LE(edges[edge].size(), 2U);
    }
}

TEST(PhotosOfFaces, InterpolateTheNormalsOfAddedVertices)
{
    TriMesh mesh = wall_mesh(1);
    mesh.normals.assign(mesh.positions.size(), {0, 0, -1});
    find_photos_of_faces(mesh, {photo_from({0, 0, -1.8})}, {});
    ASSERT_GT(mesh.positions.size(), 4U);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_TRUE(mesh.normals.back().isApprox(Eigen::Vector3f(0, 0, -1)));
}

TEST(CornerPixels, AreEmptyIfThePhotographBendsTheFace)
{
    CalibratedPhoto panorama = photo_from({0, 0, 0});
    panorama.camera = {.id = 1, .model = 17, .width_px = 160, .height_px = 80, .params = {160, 80}};
    panorama.size = {160, 80};
    // Behind the camera, across the seam between the panorama's left and right border.
    const std::array<Eigen::Vector3d, 3> across = {
        {{-0.1, 0.0, -1.0}, {0.1, 0.0, -1.0}, {0.0, 0.1, -1.0}}};
    ASSERT_TRUE(pixel_of(panorama, {0.1, 0.0, -1.0}));
    EXPECT_FALSE(corner_pixels(panorama, across));
}

TEST(PhotosOfFaces, AvoidViewsOfTheFaceBesideTheBackground)
{
    TriMesh corner = wall_mesh(6); // 6 x 6 squares of two faces
    const auto first = static_cast<std::uint32_t>(corner.positions.size());
    corner.positions.insert(corner.positions.end(), {{1, -1, 0}, {1, 1, 0}, {1, -1, 2}, {1, 1, 2}});
    corner.faces.push_back({first, first + 1, first + 2});
    corner.faces.push_back({first + 1, first + 3, first + 2});
    // Behind the wall's right edge the first camera sees nothing, the second the side wall.
    const std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -2.5}),
                                                 photo_from({1.7, 0, -2.5})};
    const auto found = find_photos_of_faces(corner, photos, Progress());
    const std::size_t middle = 2 * (2 * 6 + 3); // a face inside the wall
    const std::size_t edge = 2 * (2 * 6 + 5) + 1;
    EXPECT_EQ(found[middle].count, 2);
    ASSERT_EQ(found[edge].count, 1);
    EXPECT_EQ(found[edge].best[0].photo, 1U);
    const auto alone = find_photos_of_faces(corner, {photos[0]}, Progress());
    EXPECT_EQ(alone[edge].count, 1) << "better than no photograph";
}

} // namespace
} // namespace vcarve::face_photos_test
