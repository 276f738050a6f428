// Tests of --work, tiles and the search for photographs in runs with photographs.
#include "support/photographed_wall.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::dense_work_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// A copy of the photographed desk, and a run with dense points.
class WorkOfDenseRun : public ::testing::Test {
  protected:
    WorkOfDenseRun() { fs::copy(fixtures_folder() / "desk_photos", desk, kAll); }

    Outcome run_dense(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {desk + "/sparse", out, "--dense", "--dense-size", "160"});
        return run_program(more);
    }

    static constexpr auto kAll = fs::copy_options::recursive;
    TemporaryFolder folder;
    std::string out = folder / "out.ply";
    std::string work = folder / "work";
    std::string desk = folder / "desk";
};

TEST_F(WorkOfDenseRun, KeepsDepthMapsAfterAnInputError)
{
    for (const fs::directory_entry& photo : fs::recursive_directory_iterator(desk + "/images")) {
        if (!photo.is_regular_file()) continue;
        const fs::path name = fs::relative(photo.path(), desk + "/images");
        fs::create_directories((fs::path(desk) / "masks" / name).parent_path());
        const auto black = [](int, int) { return true; };
        write_photograph(desk + "/masks/" + name.string() + ".png", mask_image(64, 48, black));
    }
    const std::vector<std::string> all_masked = {"--masks", desk + "/masks", "--work", work};
    for (int run = 0; run < 2; ++run) {
        const Outcome outcome = run_dense(all_masked);
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_THAT(outcome.err, HasSubstr("exclude all faces"));
        EXPECT_TRUE(fs::exists(work + "/depth-11.stage")) << "hours of work would be lost";
    }
}

TEST_F(WorkOfDenseRun, MayBeInTheFolderOfThePhotographs)
{
    work = desk + "/images/w";
    const std::vector<std::string> inside = {"--images", desk + "/images", "--work",
                                             work,       "--keep-work",    "--quiet"};
    EXPECT_EQ(run_dense(inside).exit_code, 0);
    const std::string expected = bytes_of(out);
    const Outcome outcome = run_dense(inside);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(bytes_of(out) == expected);
}

TEST_F(WorkOfDenseRun, MayBeDividedIntoTilesWithImages)
{
    const Outcome outcome = run_dense({"--images", desk + "/images", "--tile-points", "2000"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("surfaces +[0-9]+ of [0-9]+ tiles"));
    EXPECT_THAT(sentence_of(2, {desk + "/sparse", out, "--images", desk + "/images",
                                "--tile-points", "2000"}),
                HasSubstr("--images needs the model in one piece"));
}

TEST_F(WorkOfDenseRun, FindsPhotographsBesideTheModelThatWasFound)
{
    const std::string project = folder / "project";
    fs::create_directories(project);
    fs::copy(desk, project + "/colmap", kAll);
    fs::create_directories(project + "/colmap/sparse/0");
    for (const char* const file : {"cameras.txt", "images.txt", "points3D.txt"}) {
        fs::rename(project + "/colmap/sparse/" + file, project + "/colmap/sparse/0/" + file);
    }
    for (const std::string& model : {project, project + "/colmap/sparse/0/cameras.txt"}) {
        const Outcome outcome = run_program({model, folder / "out.glb", "--texture"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("project/colmap/images"));
    }
}

} // namespace
} // namespace vcarve::dense_work_test
