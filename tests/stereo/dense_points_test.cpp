#include "stereo/dense_points.h"
#include "stereo/fuse.h"
#include "support/made_cells.h"
#include "support/photographed_wall.h"
#include "support/scenes.h"
#include "support/stereo_scene.h"
#include "support/temporary_folder.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace vcarve::dense_points_test {
namespace {

using Eigen::Vector3d;

/// Photographs of a textured wall, z = 2 - 0.3 x, from seven viewpoints, and a sparse surface 1 %
/// behind it. The depth of the wall differs between photographs.
struct PhotographedRoom {
    TemporaryFolder folder;
    Reconstruction sparse;
    std::vector<CalibratedPhoto> photos;

    PhotographedRoom()
    {
        const SurfaceAlong wall = plane_along({0.3, 0.0, 1.0}, 2.0);
        Scene& scene = sparse.scene;
        scene.cameras = {{.id = 1,
                          .model = 1,
                          .width_px = 160,
                          .height_px = 120,
                          .params = {150.0, 150.0, 80.0, 60.0}}};
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < 7; ++i) {
            const Vector3d center(0.15 * i - 0.45, 0.1 * (i % 3), 0.0);
            const StereoView seen = stereo_view_of(wall, i, center);
            Photograph image{160, 120, {}};
            for (const float gray : seen.image.pixels) {
                image.rgb.insert(image.rgb.end(), 3, static_cast<std::uint8_t>(gray));
            }
            CalibratedPhoto photo;
            photo.file = folder.path() / (std::to_string(i) + ".png");
            photo.size = {160, 120};
            photo.view = i;
            photo.pose.center = center;
            photo.focal_px = 150.0;
            photo.camera = scene.cameras[0];
            write_photograph(photo.file, image);
            photos.push_back(photo);
            View view;
            view.center = center;
            scene.views.push_back(view);
            all.push_back(i);
        }
        for (int i = 0; i < 40; ++i) {
            const double x = 0.03 * (i % 8) - 0.12;
            scene.positions.emplace_back(x, 0.03 * (i / 8) - 0.05, 2.0 - 0.3 * x);
            scene.colors.emplace_back();
            scene.tracks.push_back(all);
        }
        sparse.mesh.positions = {
            {-3.0, -3.0, 2.92}, {3.0, -3.0, 1.12}, {3.0, 3.0, 1.12}, {-3.0, 3.0, 2.92}};
        sparse.mesh.faces = {{0, 2, 1}, {0, 3, 2}};
    }

    DenseStereo measured(const KeepDepthMap& keep = [](std::size_t, const auto& make) {
        return make();
    }) const
    {
        DenseStereo stereo;
        stereo.views = undistort_photos(photos, {.size_px = 160}, {});
        match_views(sparse.scene, sparse.mesh, keep, stereo, {});
        return stereo;
    }
    Scene dense() const
    {
        const auto [views, neighbors, maps] = measured();
        Scene dense = fuse(sparse.scene, {views, maps, neighbors}, {});
        add_measured(sparse.scene, dense);
        return dense;
    }
};

TEST(DensePoints, LieOnTheSurface)
{
    const Scene dense = PhotographedRoom().dense();
    ASSERT_GT(dense.num_points(), 3000U);
    std::size_t near = 0;
    for (const Vector3d& position : dense.positions) {
        near += std::abs(position.z() + 0.3 * position.x() - 2.0) < 0.01 ? 1 : 0;
    }
    EXPECT_GT(static_cast<double>(near), 0.98 * static_cast<double>(dense.num_points()));
}

TEST(DensePoints, IncludeTheSparsePoints)
{
    const PhotographedRoom room;
    const Scene dense = room.dense();
    ASSERT_GT(dense.num_points(), room.sparse.scene.num_points());
    EXPECT_EQ(dense.positions.back(), room.sparse.scene.positions.back());
    EXPECT_EQ(dense.tracks.size(), dense.num_points());
}

TEST(DensePoints, SkipUnreadablePhotographsAndTransparentPixels)
{
    const PhotographedRoom room;
    Photograph cut = {160, 120, std::vector<std::uint8_t>(3 * 160 * 120, 90)};
    cut.alpha.assign(160 * 120, 255);
    cut.alpha[60 * 160 + 80] = 0;
    write_cutout(room.photos[2].file, cut);
    const StereoView view = stereo_view(room.photos[2], 160);
    EXPECT_TRUE(std::isnan(view.image.at(80, 60)));
    EXPECT_FLOAT_EQ(view.image.at(20, 60), 90.0F);

    room.folder.write("3.png", "no image");
    EXPECT_THAT(stereo_view(room.photos[3], 160).problem,
                ::testing::HasSubstr("3.png: found an unknown format"));
    EXPECT_GT(room.dense().num_points(), 1000U) << "the other photographs suffice";
}

TEST(DensePoints, AreIdenticalForAnyThreadCount)
{
    const PhotographedRoom room;
    const auto by = [&](int threads) {
        return testing::with_threads(threads, [&] { return room.dense(); });
    };
    const Scene one = by(1);
    const Scene three = by(3);
    EXPECT_EQ(one.positions, three.positions);
    EXPECT_EQ(one.tracks.views, three.tracks.views);
    EXPECT_EQ(one.colors, three.colors);
}

TEST(DensePoints, ReuseKeptDepthMaps)
{
    const PhotographedRoom room;
    std::vector<DepthMap> kept(room.photos.size());
    const DenseStereo first =
        room.measured([&](std::size_t i, const auto& make) { return kept[i] = make(); });
    const DenseStereo second =
        room.measured([&](std::size_t i, const auto& /*make*/) { return kept[i]; });
    for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_EQ(first.maps[i].costs, second.maps[i].costs);
        EXPECT_FALSE(second.maps[i].costs.empty());
    }
}

TEST(DensePoints, AreTheSparsePointsIfNoViewHasNeighbors)
{
    PhotographedRoom room;
    Scene& scene = room.sparse.scene;
    scene.tracks = {};
    for (std::uint32_t i = 0; i < scene.num_points(); ++i) {
        scene.tracks.push_back(std::vector<std::uint32_t>{i % 7});
    }
    EXPECT_EQ(room.dense().positions, scene.positions);
}

TEST(StereoBytes, GrowWithPhotographCountSizeAndThreads)
{
    const std::vector<PhotographSize> photos(7, {160, 120});
    const double bytes = stereo_bytes(photos, {.size_px = 160}, 1.0);
    EXPECT_GT(stereo_bytes(photos, {.size_px = 160}, 2.0), bytes);
    EXPECT_LT(stereo_bytes(photos, {.size_px = 100}, 1.0), bytes);
    EXPECT_LT(stereo_bytes(std::span(photos).first(3), {.size_px = 160}, 1.0), bytes);
}

} // namespace
} // namespace vcarve::dense_points_test
