#include "stereo/dense_points.h"
#include "support/made_cells.h"
#include "support/photographed_wall.h"
#include "support/recording_log.h"
#include "support/scenes.h"
#include "support/stereo_scene.h"
#include "support/temporary_folder.h"

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

    DensePoints measured(int size_px = 160) const
    {
        const auto make_anew = [](std::size_t, const std::function<DepthMap()>& make) {
            return make();
        };
        RecordingLog log;
        return dense_points(sparse, photos, {size_px}, make_anew, log);
    }
    Scene dense() const { return measured().scene; }
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
    RecordingLog log;
    const DensePoints first = dense_points(
        room.sparse, room.photos, {160},
        [&](std::size_t i, const auto& make) { return kept[i] = make(); }, log);
    const DensePoints second = dense_points(
        room.sparse, room.photos, {160}, [&](std::size_t i, const auto&) { return kept[i]; }, log);
    EXPECT_EQ(first.scene.positions, second.scene.positions);
    EXPECT_EQ(first.picture.depth.rgb, second.picture.depth.rgb);
}

TEST(DensePoints, IncludeThePictureOfADepthMap)
{
    const DepthPicture picture = PhotographedRoom().measured().picture;
    EXPECT_EQ(picture.photograph.width_px, 80);
    EXPECT_EQ(picture.depth.height_px, 60);
    EXPECT_EQ(picture.depth.rgb.size(), 3U * 80 * 60);
    EXPECT_EQ(picture.photograph.rgb.size(), picture.depth.rgb.size());
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

TEST(PredictedStereoMemory, GrowsWithPhotographCountSizeAndThreads)
{
    const PhotographedRoom room;
    const auto bytes = predicted_stereo_memory(room.photos, {160}, 1);
    EXPECT_GT(predicted_stereo_memory(room.photos, {160}, 2), bytes);
    EXPECT_LT(predicted_stereo_memory(room.photos, {100}, 1), bytes);
    EXPECT_LT(predicted_stereo_memory({room.photos.begin(), room.photos.begin() + 3}, {160}, 1),
              bytes);
}

} // namespace
} // namespace vcarve::dense_points_test
