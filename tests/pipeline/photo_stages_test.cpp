// Dense points, masks and texture through the library.
#include "pipeline/scene_run.h"
#include "pipeline/stages.h"
#include "support/places.h"
#include "support/program.h"
#include "support/recording_log.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vcarve::photo_stages_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

const std::filesystem::path kDesk = fixtures_folder() / "desk_photos";

Options dense_and_textured()
{
    Options options;
    options.dense = {.dense = true, .size_px = 100, .refine_px = 100};
    options.texture.texture = true;
    return options;
}

TEST(PhotoStages, GiveTheFileOfTheProgram)
{
    const TemporaryFolder folder;
    Log log;
    const Reconstruction made = reconstruct(kDesk / "sparse", {}, dense_and_textured(), log);
    const MeshFormat format = {.comments = made.comments, .texture = &made.texture, .up = made.up};
    write_mesh(folder / "library.glb", made.mesh, format);
    ASSERT_EQ(run_program({(kDesk / "sparse").string(), folder / "program.glb", "--dense",
                           "--dense-size", "100", "--refine-size", "100", "--texture", "--quiet"})
                  .exit_code,
              0);
    EXPECT_TRUE(bytes_of(folder / "library.glb") == bytes_of(folder / "program.glb"));
}

TEST(PhotoStages, AreThoseOfTheOneList)
{
    RecordingLog log;
    Scene scene = read_model(kDesk / "sparse", log);
    Options options = dense_and_textured();
    options.images = kDesk / "images";
    const Reconstruction made = reconstruct(std::move(scene), options, log);
    EXPECT_FALSE(made.texture.is_empty());
    EXPECT_THAT(log.ended(), IsSupersetOf({"undistort", "depth", "fuse", "merge", "photos",
                                           "colors", "texture"}));
    std::vector<std::string> listed;
    for (const RunStage& stage : all_stages()) {
        listed.emplace_back(stage.name);
    }
    for (const std::string& name : log.ended()) {
        EXPECT_THAT(listed, Contains(name));
    }
}

TEST(PhotoStages, ReportProgressAndCanBeCancelled)
{
    for (const std::string stage : {"depth", "texture"}) {
        RecordingLog log;
        log.on_share = [&](const std::string& name) {
            if (name == stage) log.stop();
        };
        EXPECT_THROW(reconstruct(kDesk / "sparse", {}, dense_and_textured(), log), Cancelled)
            << stage;
        EXPECT_FALSE(std::ranges::count(log.ended(), stage) > 0) << stage;
    }
}

TEST(Resolved, ClosesFewerGapsOfDensePointsUnlessTheUserSaysSo)
{
    Options options;
    EXPECT_EQ(resolved(options).surface.rules.max_closing, FaceRules::kAutoClosing);
    options.dense.dense = true;
    EXPECT_EQ(resolved(options).surface.rules.max_closing, 0.02);
    options.surface.rules.max_closing = 0.115;
    EXPECT_EQ(resolved(options).surface.rules.max_closing, 0.115);
}

TEST(PhotoStages, RejectTwoSourcesOfDensePoints)
{
    Log log;
    EXPECT_THAT(refusal<UsageError>([&] {
                    reconstruct(kDesk / "sparse", {.points = "dense"}, dense_and_textured(), log);
                }),
                HasSubstr("both supply dense points"));
    Scene cloud;
    cloud.is_dense = true;
    EXPECT_THAT(refusal<UsageError>([&] { reconstruct(cloud, dense_and_textured(), log); }),
                HasSubstr("both supply dense points"));
}

} // namespace
} // namespace vcarve::photo_stages_test
