#include "io/input/read_model.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/told_log.h"
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
        ToldLog log;
        return refusal<InputError>([&] { read_model(input, log); });
    }

    TemporaryFolder folder;
    std::filesystem::path model = folder / "m";
};

TEST_F(ReadModelOfBall, SaysWhatToDoWhereThereIsNothingToMesh)
{
    folder.write("m/points3D.txt", "# nothing\n");
    EXPECT_EQ(refused(model), (model / "points3D.txt").string() +
                                  ": holds no points; colmap point_triangulator makes them where "
                                  "poses are known");
    folder.write("m/images.txt", "");
    EXPECT_THAT(refused(model), StartsWith((model / "images.txt").string() + ": holds no images"));
}

TEST_F(ReadModelOfBall, SaysWhatToDoAboutACloudWithoutPoints)
{
    folder.copy(model, "dense/sparse");
    Scene nothing;
    folder.write("dense/fused.ply", cloud_bytes(nothing, CloudEncoding::binary));
    folder.write("dense/fused.ply.vis", visibility_bytes(nothing.tracks));
    EXPECT_THAT(refused(folder / "dense"), StartsWith((folder / "dense/fused.ply").string() +
                                                      ": holds no points; where stereo_fusion"));
    EXPECT_THAT(refused(folder / "dense"), EndsWith("--points sparse takes those of the model"));
}

TEST_F(ReadModelOfBall, NotesWhatWasTakenForUnknown)
{
    std::string points = bytes_of(model / "points3D.txt");
    for (std::size_t at = 0; (at = points.find("200 100 50 0.5", at)) != std::string::npos;) {
        points.replace(at, 14, "0 0 0 0.0");
    }
    folder.write("m/points3D.txt", points);
    ToldLog log;
    const ReadModel read = read_found_model(model, {}, log);
    EXPECT_THAT(read.found.notes, Contains(HasSubstr("the error of every point is 0")));
    EXPECT_THAT(read.found.notes, Contains(HasSubstr("the points have no colours")));
    EXPECT_THAT(read.scene.errors_px, ::testing::Each(-1.0));
}

TEST_F(ReadModelOfBall, WarnsOfPosesFromCameraToWorld)
{
    // From camera to world: the centre stands in the place of the translation.
    write_ball_model(model, 60, {2, 3, 5});
    const Scene scene = read_colmap_model(model, ModelFormat::text);
    std::string images;
    for (const View& view : scene.views) {
        const Eigen::Quaterniond q = view.cam_from_world.conjugate();
        images += fmt::format("{} {} {} {} {} {} {} {} 1 a\n\n", view.id, q.w(), q.x(), q.y(),
                              q.z(), view.center.x(), view.center.y(), view.center.z());
    }
    folder.write("m/images.txt", images);
    ToldLog log;
    EXPECT_THAT(read_found_model(model, {}, log).found.notes,
                Contains(HasSubstr("camera-to-world")));
}

} // namespace
} // namespace vcarve::read_model_test
