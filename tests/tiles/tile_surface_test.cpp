#include "support/scenes.h"
#include "tiles/tile_runs.h"
#include "tiles/tile_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace vcarve::tile_surface_test {
namespace {

/// Two fans of two faces that touch in a split vertex. Points 1 and 4 are those of tile 0, and all
/// others of tile 1. The first face of a fan belongs to tile 0.
struct TouchingFans {
    explicit TouchingFans(bool is_reversed)
    {
        mesh.positions = {{0, 0, 0}, {1, -1, 0}, {1, 0, 0},  {1, 1, 0},
                          {0, 0, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
        mesh.points = {0, 1, 2, 3, 0, 4, 5, 6};
        mesh.faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
        mesh.normals.assign(8, Eigen::Vector3f(0, 0, 1));
        point_ids = {tile_point(1, 9), tile_point(0, 1), tile_point(1, 2), tile_point(1, 3),
                     tile_point(0, 4), tile_point(1, 5), tile_point(1, 6)};
        if (!is_reversed) return;
        std::ranges::reverse(mesh.positions);
        std::ranges::reverse(mesh.points);
        std::ranges::reverse(mesh.faces);
        for (Face& face : mesh.faces) {
            for (std::uint32_t& vertex : face) {
                vertex = 7 - vertex;
            }
        }
    }

    TileSurface of(std::size_t tile) const
    {
        return owned_faces(tile, divide({}, 1), mesh, point_ids, {});
    }

    TriMesh mesh;
    std::vector<std::uint64_t> point_ids;
};

/// The name of each shared vertex, by the x of another corner of its face.
std::set<std::pair<double, std::uint64_t>> copies_in(const TileSurface& tile)
{
    std::set<std::pair<double, std::uint64_t>> found;
    for (std::size_t i = 0; i < tile.shared.size(); ++i) {
        if (!tile.mesh.positions[tile.shared[i]].isZero()) continue;
        for (const Face& face : tile.mesh.faces) {
            if (std::ranges::count(face, tile.shared[i]) == 0) continue;
            const auto other = std::ranges::find_if(face, [&](std::uint32_t v) {
                return tile.mesh.positions[v].y() == 0.0 && v != tile.shared[i];
            });
            found.emplace(tile.mesh.positions[*other].x(), tile.names[i].copy);
        }
    }
    return found;
}

TEST(OwnedFaces, AreThoseWithTheLeastPointInTheTile)
{
    const TouchingFans fans(false);
    EXPECT_EQ(fans.of(0).mesh.faces.size(), 2U);
    EXPECT_EQ(fans.of(1).mesh.faces.size(), 2U);
    EXPECT_TRUE(fans.of(2).mesh.faces.empty());
    EXPECT_EQ(fans.of(0).shared.size(), 4U);
    EXPECT_EQ(fans.of(0).seam_edges.size(), 2U);
}

TEST(OwnedFaces, NameCopiesOfAVertexAlikeInAllTiles)
{
    const auto copies = copies_in(TouchingFans(false).of(0));
    EXPECT_EQ(copies.size(), 2U);
    EXPECT_NE(copies.begin()->second, copies.rbegin()->second);
    EXPECT_EQ(copies_in(TouchingFans(false).of(1)), copies);
    EXPECT_EQ(copies_in(TouchingFans(true).of(0)), copies) << "for any order of the vertices";
    EXPECT_EQ(copies_in(TouchingFans(true).of(1)), copies);
}

TEST(TileSurface, AcceptsPointsAtTheSamePosition)
{
    Scene scene = bumpy_sphere(500, 3);
    scene.positions.push_back(scene.positions[7]);
    scene.colors.push_back(scene.colors[7]);
    scene.errors_px.push_back(scene.errors_px[7]);
    scene.tracks.push_back(std::vector<std::uint32_t>{0, 1});
    scene.point_ids.resize(scene.num_points());
    std::iota(scene.point_ids.begin(), scene.point_ids.end(), 0U);
    const Tiling one = divide({}, 1);
    const TileSurface made = tile_surface(0, scene, {one, Options(), UsualValues(), Log()});
    EXPECT_GT(made.mesh.faces.size(), 500U);
    EXPECT_TRUE(made.shared.empty());
}

} // namespace
} // namespace vcarve::tile_surface_test
