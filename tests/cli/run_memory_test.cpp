#include "cli/run_memory.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace vcarve::cli::run_memory_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

struct Notes : Log {
    void note(std::string_view sentence) override { heard.emplace_back(sentence); }
    std::vector<std::string> heard;
};

constexpr SceneSize kSmall = {.points = 1000, .rays = 4000, .views = 3};
const RunSize kRun = {.read = kSmall, .thinned = kSmall};

TEST(ArrayFolder, CreatesATemporaryFolderBesideTheOutputByDefault)
{
    const TemporaryFolder folder;
    {
        const ArrayFolder work({}, folder / "out.ply");
        EXPECT_TRUE(work.is_temporary());
        EXPECT_THAT(work.path().string(), HasSubstr((folder / "out.ply.scratch-").string()));
        EXPECT_FALSE(std::filesystem::exists(work.path())) << "not created before it is needed";
        work.prepare(0);
        EXPECT_TRUE(std::filesystem::is_directory(work.path()));
    }
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(ArrayFolder, KeepsAGivenFolder)
{
    const TemporaryFolder folder;
    {
        const ArrayFolder work(folder.path(), "out.ply");
        EXPECT_FALSE(work.is_temporary());
        work.prepare(0);
    }
    EXPECT_TRUE(std::filesystem::exists(folder.path()));
}

TEST(ArrayFolder, AvoidsTheFolderOfADevice)
{
    EXPECT_NE(ArrayFolder({}, "/dev/null").path().parent_path(), "/dev");
}

TEST(ArrayFolder, ReportsWhyAFolderCannotBeUsed)
{
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "").string();
    EXPECT_EQ(refusal<UsageError>([&] { ArrayFolder(file, "out.ply").prepare(0); }),
              "cannot use the work folder " + file + ": it is not a folder");
    const std::string nowhere = folder / "no/where";
    EXPECT_EQ(refusal<UsageError>([&] { ArrayFolder(nowhere, "out.ply").prepare(0); }),
              "cannot use the work folder " + nowhere + ": No such file or directory");
    EXPECT_THAT(refusal<UsageError>(
                    [&] { ArrayFolder(folder.path(), "out.ply").prepare(std::int64_t{1} << 60); }),
                MatchesRegex("cannot use the work folder .*: [0-9.]+[KMG]? are free there, but "
                             "about 1.074e\\+09G are needed"));
}

TEST(RunMemory, WorksInMemoryWithoutAFolderIfTheRunFits)
{
    const TemporaryFolder folder;
    const ArrayFolder work({}, folder / "out.ply");
    RunMemory memory({.limit = std::int64_t{1} << 30}, 1, work);
    Notes notes;
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.options().blocks, 0);
    EXPECT_EQ(memory.options().limit, std::int64_t{1} << 30);
    EXPECT_EQ(allocate_scratch(ScratchMemory::kLeastBytes, 16), nullptr);
    EXPECT_EQ(folder.num_entries(), 0U);
    EXPECT_THAT(notes.heard, IsEmpty());
}

TEST(RunMemory, KeepsArraysOfBlocksInFilesAndNotesThePlanOnce)
{
    const TemporaryFolder folder;
    const ArrayFolder work({}, folder / "out.ply");
    {
        RunMemory memory({.limit = 0, .blocks = 7}, 1, work);
        Notes notes;
        memory.fit(kRun, notes);
        memory.fit(kRun, notes);
        EXPECT_EQ(memory.options().blocks, 7);
        EXPECT_EQ(memory.record()["blocks"], 7);
        EXPECT_THAT(notes.heard,
                    ElementsAre(MatchesRegex("about [0-9.]+M needed, no limit: 7 blocks, scratch "
                                             "of about [0-9.]+K in .*out.ply.scratch-[0-9]+")));
        void* const array = allocate_scratch(ScratchMemory::kLeastBytes, 16);
        EXPECT_TRUE(free_scratch(array));
        EXPECT_TRUE(std::filesystem::exists(work.path()));
    }
    EXPECT_EQ(allocate_scratch(ScratchMemory::kLeastBytes, 16), nullptr);
}

TEST(RunMemory, KeepsUsingFilesIfTheThinnedCloudWouldFit)
{
    const TemporaryFolder folder;
    const ArrayFolder work({}, folder / "out.ply");
    RunSize read = kRun;
    read.read.points = 10'000'000;
    const std::int64_t most = std::int64_t{500} << 20;
    RunMemory memory({.limit = most}, 1, work);
    Notes notes;
    memory.fit(read, notes);
    EXPECT_EQ(memory.options().blocks, 2);
    memory.fit(kRun, notes);
    EXPECT_EQ(memory.options().blocks, 2);
    EXPECT_EQ(notes.heard.size(), 1U);
}

TEST(RunMemory, RejectsAnUnusableFolderBeforeItIsNeeded)
{
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "").string();
    const ArrayFolder work(file, "out.ply");
    EXPECT_THAT(refusal<UsageError>([&] { RunMemory({}, 1, work); }),
                HasSubstr("cannot use the work folder"));
}

TEST(RunMemory, AllowsTheGivenLimitOrMostOfTheFreeMemory)
{
    EXPECT_EQ(allowed_memory({.limit = 1000}), 1000);
    EXPECT_EQ(allowed_memory({.limit = 0}), std::nullopt) << "no limit";
    EXPECT_GT(allowed_memory({}), 1000);
}

} // namespace
} // namespace vcarve::cli::run_memory_test
