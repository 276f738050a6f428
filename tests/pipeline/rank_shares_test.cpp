// Runs on several ranks that share a work folder.
#include "pipeline/rank_shares.h"
#include "pipeline/run_state.h"
#include "pipeline/thinned_scene.h"
#include "steps/4_visibility/energy_sums.h"
#include "support/ranks_in_turn.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace vcarve::rank_shares_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Job kJob = {{"points3D.bin", "12 bytes"}};

struct NotingLog final : Log {
    void note(std::string_view sentence) override { notes.emplace_back(sentence); }
    std::vector<std::string> notes;
};

Options in_blocks(int blocks)
{
    Options options;
    options.memory.blocks = blocks;
    return options;
}

struct Made {
    TriMesh mesh;
    std::vector<std::string> tasks;
    std::vector<std::string> files;
    std::vector<std::string> notes;
};

class RanksOfARun : public ::testing::Test {
  protected:
    using Meddle = std::function<void(const std::string& task)>;

    Made made_by(std::size_t count, const Options& options, const Meddle& meddle = {}) const
    {
        WorkFolder work(folder / "work");
        work.begin(kJob);
        RanksInTurn ranks(work, options, count);
        if (meddle) ranks.after_share = meddle;
        NotingLog log;
        Made made;
        made.mesh = reconstruct_thinned(scene, size_of(scene), options, log,
                                        {.work = &work, .ranks = &ranks})
                        .mesh;
        made.tasks = ranks.tasks;
        made.files = ranks.files;
        made.notes = log.notes;
        work.clear();
        return made;
    }

    void expect_the_same_of_all(const Options& options) const
    {
        Log silent;
        const TriMesh alone = reconstruct_thinned(scene, size_of(scene), options, silent).mesh;
        ASSERT_FALSE(alone.faces.empty());
        for (const std::size_t count : {1U, 2U, 4U, 7U}) {
            const TriMesh mesh = made_by(count, options).mesh;
            EXPECT_TRUE(mesh.positions == alone.positions) << count;
            EXPECT_TRUE(mesh.faces == alone.faces) << count;
            EXPECT_TRUE(mesh.colors == alone.colors) << count;
        }
    }

    std::filesystem::path file_of(const std::string& stage) const
    {
        return folder / "work" / (stage + ".stage");
    }

    TemporaryFolder folder;
    Scene scene = bumpy_sphere(1500, 3);
};

TEST_F(RanksOfARun, MakeTheSameSurfaceAsOneProcess)
{
    expect_the_same_of_all(in_blocks(8));
    expect_the_same_of_all(in_blocks(2)); // fewer than ranks
    expect_the_same_of_all(in_blocks(0));
}

TEST_F(RanksOfARun, MakeTheSameSurfaceWithVirtualViewsAndMethodStrict)
{
    Options options = in_blocks(4);
    options.labels.virtual_views.count = 20;
    expect_the_same_of_all(options);
    options.labels.method = Method::strict;
    expect_the_same_of_all(options);
}

TEST_F(RanksOfARun, MakeTheSameSurfaceWithBundledRays)
{
    scene.is_dense = true;
    expect_the_same_of_all(in_blocks(4));
}

TEST_F(RanksOfARun, ShareTheBlocksAndTheRaysOfThePhotographs)
{
    Options options = in_blocks(4);
    options.labels.virtual_views.count = 20;
    EXPECT_THAT(made_by(3, options).tasks, ElementsAre(kBlocksTask, kRaysTask));
    EXPECT_THAT(made_by(1, options).tasks, IsEmpty()) << "no other ranks";
    options.memory.blocks = 0;
    EXPECT_THAT(made_by(3, options).tasks, ElementsAre(kRaysTask));
}

TEST_F(RanksOfARun, SaveTheirSharesInTheFolderForRankZero)
{
    std::vector<std::string> found;
    made_by(3, in_blocks(5), [&](const std::string& task) {
        for (const auto* const name : {"cells-0-of-5", "cells-1-of-5", "cells-4-of-5",
                                       "rays-0-of-3", "rays-1-of-3", "rays-2-of-3"}) {
            if (std::filesystem::exists(file_of(name))) found.push_back(task + ": " + name);
        }
    });
    EXPECT_THAT(found, ElementsAre("task-blocks: cells-0-of-5", "task-blocks: cells-1-of-5",
                                   "task-blocks: cells-4-of-5", "task-rays: rays-1-of-3",
                                   "task-rays: rays-2-of-3"));
    EXPECT_FALSE(std::filesystem::exists(folder / "work")) << "the folder is removed at the end";
}

TEST_F(RanksOfARun, RecomputeTruncatedAndMissingShares)
{
    const TriMesh whole = made_by(1, in_blocks(4)).mesh;
    const Made repaired = made_by(3, in_blocks(4), [&](const std::string& task) {
        const auto path = file_of(task == kBlocksTask ? "cells-1-of-4" : "rays-2-of-3");
        std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
        std::filesystem::remove(file_of("rays-1-of-3"));
    });
    EXPECT_EQ(repaired.mesh.faces, whole.faces);
    EXPECT_EQ(repaired.mesh.positions, whole.positions);
    EXPECT_THAT(repaired.notes, ::testing::Contains(HasSubstr("cells-1-of-4.stage: it has ")));
    EXPECT_THAT(repaired.notes, ::testing::Contains(HasSubstr("rays-2-of-3.stage: it has ")));
}

TEST_F(RanksOfARun, ReuseTheSharesOfAFailedRun)
{
    const auto end = [](const std::string& task) {
        if (task == kRaysTask) throw std::runtime_error("a rank died");
    };
    EXPECT_EQ(refusal<std::runtime_error>([&] { made_by(3, in_blocks(4), end); }), "a rank died");
    const auto written = std::filesystem::last_write_time(file_of("rays-1-of-3"));
    std::filesystem::file_time_type found;
    const Made mesh = made_by(3, in_blocks(4), [&](const std::string& /*task*/) {
        found = std::filesystem::last_write_time(file_of("rays-1-of-3"));
    });
    EXPECT_EQ(found, written) << "its rays were not followed again";
    EXPECT_THAT(mesh.tasks, ElementsAre(kRaysTask)) << "the cells were saved";
    EXPECT_EQ(mesh.mesh.faces, made_by(1, in_blocks(4)).mesh.faces);
}

TEST_F(RanksOfARun, RejectStagesOfAnotherJob)
{
    WorkFolder work(folder / "work");
    work.begin(kJob);
    work.save("points", {}, std::vector<LogEvent>(), CarvingPoints{scene, {}});
    work.save(kBlocksTask, {}, BlocksTask{4});
    WorkFolder joined(work.path(), digest_of(Job{{"points3D.bin", "13 bytes"}}));
    const Options options = in_blocks(4);
    RankShares shares(joined, options, {1, 2});
    Log silent;
    EXPECT_THAT(refusal<InputError>([&] { shares.work(kBlocksTask, silent); }),
                HasSubstr("task-blocks.stage: it was made from other input or options"));
}

TEST(SharesOfRays, CoverAllRaysOnceInSimilarNumbers)
{
    const Scene scene = bumpy_sphere(500, 3);
    for (const std::size_t count : {1U, 2U, 5U, 600U}) {
        Index next = 0;
        for (std::size_t number = 0; number < count; ++number) {
            const VertexRun run = share_of(scene.tracks, {number, count});
            EXPECT_EQ(run.first, next);
            next = run.last;
            const std::uint64_t rays =
                scene.tracks.begins[run.last] - scene.tracks.begins[run.first];
            EXPECT_NEAR(static_cast<double>(rays),
                        static_cast<double>(scene.num_rays()) / static_cast<double>(count), 60.0);
        }
        EXPECT_EQ(next, scene.num_points());
    }
    EXPECT_EQ(share_of({}, {1, 2}).last, 0U);
}

TEST(SharesOfRays, SkipRunsOfCellsWithoutVotes)
{
    constexpr std::size_t kRun = kSumsOfRun;
    std::vector<std::int32_t> sums(3 * kRun + kRun / 2, 0);
    sums[kRun] = 4;
    sums.back() = -2;
    const SparseSums<std::int32_t> sparse = sparse_sums(sums);
    EXPECT_THAT(sparse.runs, ElementsAre(1, 3));
    EXPECT_EQ(sparse.values.size(), kRun + kRun / 2);
    std::vector<std::int32_t> twice = sums;
    add_sparse(sparse, twice, [](std::int32_t& sum, std::int32_t value) { sum += value; });
    EXPECT_EQ(twice[kRun], 8);
    EXPECT_EQ(twice.back(), -4);
    EXPECT_THAT(sparse_sums(std::vector<std::int32_t>(kRun, 0)).values, IsEmpty());
    std::vector<std::int32_t> others(kRun);
    EXPECT_THROW(add_sparse(sparse, others, [](auto&, auto) {}), std::logic_error);
}

} // namespace
} // namespace vcarve::rank_shares_test
