#include "render/raster.h"
#include "render/shapes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace vcarve::render::raster_test {

namespace {

/// A box of edge 2. Its near side fills the central 4 x 4 of the 8 x 6 pixels of view_ahead().
TriMesh box_ahead()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, 4.0}, {2.0, 2.0, 2.0}}, {});
    return builder.take().mesh;
}

/// A view from the origin along z.
Pinhole view_ahead()
{
    Pinhole view;
    view.focal_px = {8.0, 8.0};
    view.principal_px = {4.0, 3.0};
    view.width_px = 8;
    view.height_px = 6;
    return view;
}

/// The index of the face at each pixel, '.' for the background.
std::vector<std::string> faces_shown(const std::vector<Hit>& hits, int width_px)
{
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (i % width_px == 0) rows.emplace_back();
        rows.back() += hits[i].face == Hit::kNoFace ? "." : std::to_string(hits[i].face);
    }
    return rows;
}

/// The first hit of a ray from the view's center; tries every face.
Hit nearest_face(const TriMesh& mesh, const Pinhole& view, const Eigen::Vector3d& ray)
{
    Hit nearest;
    nearest.depth = std::numeric_limits<double>::infinity();
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        const auto& [a, b, c] = mesh.faces[face];
        // center + depth ray = a + s (b - a) + t (c - a)
        Eigen::Matrix3d system;
        system << -ray, mesh.positions[b] - mesh.positions[a],
            mesh.positions[c] - mesh.positions[a];
        const Eigen::Vector3d solution = system.fullPivLu().solve(view.center - mesh.positions[a]);
        const double depth = solution[0];
        const bool met = solution[1] >= 0.0 && solution[2] >= 0.0 &&
                         solution[1] + solution[2] <= 1.0 && depth > 0.0;
        if (met && depth < nearest.depth) {
            nearest = {face, face_normal(mesh, face).dot(ray) < 0.0, depth};
        }
    }
    return nearest;
}

} // namespace

TEST(Raster, ShowsTheNearSideOfABoxExactly)
{
    const std::vector<Hit> hits = rasterize(box_ahead(), view_ahead());
    const std::vector<std::string> expected = {"........", "..0111..", "..0011..",
                                               "..0001..", "..0000..", "........"};
    EXPECT_EQ(faces_shown(hits, 8), expected);
    for (const Hit& hit : hits) {
        if (hit.face == Hit::kNoFace) continue;
        EXPECT_EQ(hit.depth, 4.0);
        EXPECT_TRUE(hit.front);
    }
}

TEST(Raster, ShowsTheBackOfTheFarSideFromInsideTheBox)
{
    Pinhole view = view_ahead();
    view.center = {0.0, 0.0, 5.5};
    const std::vector<Hit> hits = rasterize(box_ahead(), view);
    // The far side, half a unit ahead, is 32 pixels wide and fills the image.
    ASSERT_EQ(hits.size(), 48U);
    for (const Hit& hit : hits) {
        EXPECT_EQ(hit.depth, 0.5);
        EXPECT_FALSE(hit.front);
        EXPECT_TRUE(hit.face == 2 || hit.face == 3);
    }
}

TEST(Raster, AgreesWithBruteForce)
{
    PartBuilder builder;
    add_box(builder, {{0.2, 0.1, -0.3}, {1.0, 0.7, 1.3}, 24.0}, {});
    add_sphere(builder, {-0.6, -0.5, 0.4}, 0.43, {});
    add_ring(builder, {0.7, -0.6, 0.3}, {0.4, 0.13}, {});
    const TriMesh mesh = builder.take().mesh;
    const Pinhole view = looking_at({31, 23, 27.0}, {0.9, -2.7, 1.1}, {0.05, 0.0, 0.2});
    const std::vector<Hit> hits = rasterize(mesh, view);
    ASSERT_EQ(hits.size(), 31U * 23U);
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            const Hit expected = nearest_face(mesh, view, view.ray({x + 0.5, y + 0.5}));
            const Hit& hit = hits[y * view.width_px + x];
            ASSERT_EQ(hit.face, expected.face) << "pixel " << x << ", " << y;
            if (hit.face == Hit::kNoFace) continue;
            EXPECT_NEAR(hit.depth, expected.depth, 1e-9);
            EXPECT_EQ(hit.front, expected.front);
        }
    }
}

TEST(Raster, ClipsFacesThatReachBehindTheCamera)
{
    // A floor 1 below the camera, from far behind to far ahead: the horizon is the middle row.
    TriMesh floor;
    floor.positions = {{-1e3, 1.0, -1e3}, {1e3, 1.0, -1e3}, {1e3, 1.0, 1e3}, {-1e3, 1.0, 1e3}};
    floor.faces = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<Hit> hits = rasterize(floor, view_ahead());
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 8; ++x) {
            const Hit& hit = hits[y * 8 + x];
            ASSERT_EQ(hit.face == Hit::kNoFace, y < 3) << "pixel " << x << ", " << y;
            const double expected = y < 3 ? 0.0 : 8.0 / (y + 0.5 - 3.0);
            EXPECT_NEAR(hit.depth, expected, 1e-9);
        }
    }
}

} // namespace vcarve::render::raster_test
