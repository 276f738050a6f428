#include "io/colmap/colmap_model.h"
#include "io/input/read_model.h"
#include "model/camera.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/recording_log.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::read_model_test {
namespace {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ReadModelOfBall : public ::testing::Test {
  protected:
    ReadModelOfBall() { write_ball_model(folder / "m", 60); }

    std::string refused(const std::filesystem::path& input) const
    {
        RecordingLog log;
        return refusal<InputError>([&] { read_model(input, log); });
    }

    TemporaryFolder folder;
    std::filesystem::path model = folder / "m";
};

TEST_F(ReadModelOfBall, ReportsRemediesForEmptyModels)
{
    folder.write("m/points3D.txt", "# nothing\n");
    EXPECT_EQ(refused(model), (model / "points3D.txt").string() +
                                  ": has no points; colmap point_triangulator computes points if "
                                  "poses are known");
    folder.write("m/images.txt", "");
    EXPECT_THAT(refused(model), StartsWith((model / "images.txt").string() + ": has no images"));
}

TEST_F(ReadModelOfBall, ReportsRemediesForEmptyClouds)
{
    folder.copy(model, "dense/sparse");
    Scene nothing;
    folder.write("dense/fused.ply", cloud_bytes(nothing, CloudEncoding::binary));
    folder.write("dense/fused.ply.vis", visibility_bytes(nothing.tracks));
    EXPECT_THAT(refused(folder / "dense"), StartsWith((folder / "dense/fused.ply").string() +
                                                      ": has no points; run stereo_fusion"));
    EXPECT_THAT(refused(folder / "dense"), EndsWith("the points of the model (--points sparse)"));
}

TEST_F(ReadModelOfBall, NotesUnknownErrorsAndColors)
{
    std::string points = bytes_of(model / "points3D.txt");
    for (std::size_t at = 0; (at = points.find("200 100 50 0.5", at)) != std::string::npos;) {
        points.replace(at, 14, "0 0 0 0.0");
    }
    folder.write("m/points3D.txt", points);
    RecordingLog log;
    const ReadModel read = read_found_model(find_input(model, {}), log);
    EXPECT_THAT(read.found.notes, Contains(HasSubstr("the error of every point is 0")));
    EXPECT_THAT(read.found.notes, Contains(HasSubstr("the points have no colors")));
    EXPECT_THAT(read.scene.errors_px, ::testing::Each(-1.0));
}

TEST_F(ReadModelOfBall, WarnsAboutCameraToWorldPoses)
{
    // Camera-to-world poses have the center instead of the translation.
    write_ball_model(model, 60, {2, 3, 5});
    const Scene scene = read_colmap_model(model, ModelFormat::text);
    std::string images;
    for (const View& view : scene.views) {
        const Eigen::Quaterniond q = view.cam_from_world.conjugate();
        images += fmt::format("{} {} {} {} {} {} {} {} 1 a\n\n", view.id, q.w(), q.x(), q.y(),
                              q.z(), view.center.x(), view.center.y(), view.center.z());
    }
    folder.write("m/images.txt", images);
    RecordingLog log;
    EXPECT_THAT(read_found_model(find_input(model, {}), log).found.notes,
                Contains(HasSubstr("camera-to-world")));
}

TEST_F(ReadModelOfBall, AcceptsPointsBeyondTheEdgesOfCroppedImages)
{
    // Crops images to 50 x 50 of 1000 x 1000 pixels.
    folder.write("m/cameras.txt", "1 SIMPLE_PINHOLE 50 50 1000 25 25\n");
    const auto notes = [&](double off_px) {
        const Scene scene = read_colmap_model(model, ModelFormat::text);
        std::string images;
        for (std::uint32_t i = 0; i < scene.views.size(); ++i) {
            const View& view = scene.views[i];
            const Eigen::Quaterniond& q = view.cam_from_world;
            const Eigen::Vector3d shift = -(q * view.center);
            images += fmt::format("{} {} {} {} {} {} {} {} 1 a\n", view.id, q.w(), q.x(), q.y(),
                                  q.z(), shift.x(), shift.y(), shift.z());
            for (std::size_t point = 0; point < scene.num_points(); ++point) {
                if (std::ranges::count(scene.tracks[point], i) == 0) continue;
                const auto place = project(scene.cameras[0], q * scene.positions[point] + shift);
                images += fmt::format("{} {} {} ", place->x() + off_px, place->y(),
                                      scene.point_ids[point]);
            }
            images += "\n";
        }
        folder.write("m/images.txt", images);
        RecordingLog log;
        return read_found_model(find_input(model, {}), log).found.notes;
    };
    EXPECT_THAT(notes(3.0), ::testing::IsEmpty());
    EXPECT_THAT(notes(5.0), Contains(HasSubstr("do not seem to match")));
}

} // namespace
} // namespace vcarve::read_model_test
