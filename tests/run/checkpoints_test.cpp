#include "base/parallel.h"
#include "run/checkpoints.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

namespace vcarve::checkpoints_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Numbers = std::vector<std::uint32_t>;

/// Records ends of stages and notes, except the checkpoints' own stages.
class Lines final : public Log {
  public:
    void stage_ends(std::string_view name, const Counts& counts) override
    {
        if (name == "keep" || name == "resume") return;
        lines.push_back(std::string(name));
        for (const auto& [what, count] : counts) {
            lines.back() += fmt::format(" {} {}", count, what);
        }
    }
    void note(std::string_view sentence) override { notes.emplace_back(sentence); }

    std::vector<std::string> lines;
    std::vector<std::string> notes;
};

/// Consecutive runs in the same folder.
class CheckpointsOfRuns : public ::testing::Test {
  protected:
    /// Runs once. Members record the messages, and how often stages were computed.
    template <typename Run>
    auto run(const Run& run)
    {
        log = {};
        inner_made = outer_made = 0;
        WorkFolder work(folder.path());
        work.begin({{"a", "b"}});
        Checkpoints keeper(&work, log);
        return run(keeper);
    }
    /// A stage that contains another stage.
    Numbers outer(Checkpoints& keeper)
    {
        Numbers numbers;
        keeper.keep("outer", numbers, [&] {
            keeper.keep("inner", numbers, [&] {
                ++inner_made;
                report(keeper.log(), "first");
                numbers = {1, 2, 3};
            });
            ++outer_made;
            keeper.log().note("a note");
            report(keeper.log(), "second");
            numbers.push_back(4);
        });
        return numbers;
    }
    static void report(Log& log, std::string_view name)
    {
        Stage stage(log, name);
        stage.end({{"numbers", 3}});
    }
    void damage(const std::string& file) const
    {
        std::fstream(folder / file, std::ios::in | std::ios::out).seekp(200) << "damage";
    }
    void remove(const std::string& file) const { std::filesystem::remove(folder / file); }

    const Numbers expected = {1, 2, 3, 4};
    TemporaryFolder folder;
    Lines log;
    int inner_made = 0;
    int outer_made = 0;
};

} // namespace

TEST_F(CheckpointsOfRuns, ComputesEveryStageWithoutAFolder)
{
    Checkpoints keeper(nullptr, log);
    EXPECT_EQ(&keeper.log(), &log);
    EXPECT_EQ(outer(keeper), expected);
    EXPECT_EQ(outer(keeper), expected);
    EXPECT_EQ(outer_made, 2);
    EXPECT_THAT(log.notes, ElementsAre("a note", "a note"));
}

TEST_F(CheckpointsOfRuns, LoadsASavedStageAndReplaysItsLog)
{
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_THAT(log.lines, ElementsAre("first 3 numbers", "second 3 numbers"));
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_EQ(inner_made + outer_made, 0);
    EXPECT_THAT(log.lines, ElementsAre("first 3 numbers", "second 3 numbers"));
    EXPECT_THAT(log.notes, ElementsAre("checkpoint outer in the folder " + folder.path().string() +
                                           " replaces the stages first, second",
                                       "a note"));
}

TEST_F(CheckpointsOfRuns, ResumesAfterTheLastSavedStage)
{
    run([&](auto& keeper) { return outer(keeper); });
    remove("outer.stage");
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_EQ(inner_made, 0);
    EXPECT_EQ(outer_made, 1);
    // The enclosing stage also records the messages of a loaded stage.
    remove("inner.stage");
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_EQ(outer_made, 0);
    EXPECT_THAT(log.lines, ElementsAre("first 3 numbers", "second 3 numbers"));
}

TEST_F(CheckpointsOfRuns, RecomputesADamagedStageWithANote)
{
    run([&](auto& keeper) { return outer(keeper); });
    damage("outer.stage");
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_EQ(inner_made, 0);
    EXPECT_EQ(outer_made, 1);
    ASSERT_FALSE(log.notes.empty());
    EXPECT_THAT(log.notes[0], HasSubstr("outer.stage: its content is damaged"));
    EXPECT_THAT(log.notes[0], HasSubstr("; it is computed again"));
    run([&](auto& keeper) { return outer(keeper); });
    EXPECT_EQ(outer_made, 0); // the file is valid again
}

TEST_F(CheckpointsOfRuns, ContinuesWithANoteIfAStageCannotBeWritten)
{
    const auto once_unwritable = [&](Checkpoints& keeper) {
        // A folder in place of the file prevents writing.
        std::filesystem::create_directory(folder /
                                          ("outer.stage.part-" + std::to_string(::getpid())));
        return outer(keeper);
    };
    EXPECT_EQ(run(once_unwritable), expected);
    ASSERT_EQ(log.notes.size(), 2U);
    EXPECT_THAT(log.notes[1], HasSubstr("cannot write " + (folder / "outer.stage").string()));
    EXPECT_THAT(log.notes[1], HasSubstr("; the run continues without a checkpoint of "
                                        "outer"));
    EXPECT_EQ(run([&](auto& keeper) { return outer(keeper); }), expected);
    EXPECT_EQ(inner_made, 0);
    EXPECT_EQ(outer_made, 1);
}

TEST_F(CheckpointsOfRuns, SavesNothingOfAFailedStage)
{
    const auto fail = [](Checkpoints& keeper) {
        Numbers numbers;
        keeper.keep("numbers", numbers, [] { throw InputError("no numbers"); });
        return numbers;
    };
    EXPECT_EQ(refusal<InputError>([&] { run(fail); }), "no numbers");
    EXPECT_EQ(folder.num_entries(), 0U);
}

/// A stage in parts, computed on all threads; parts from `most` on fail.
class PiecesOfCheckpoints : public CheckpointsOfRuns {
  protected:
    Numbers squares(Checkpoints& keeper, std::size_t of, std::size_t most)
    {
        Numbers all;
        keeper.keep("squares", all, [&] {
            all.resize(of);
            parallel_for(
                of,
                [&](std::size_t i) {
                    const Numbers part = keeper.piece({"squares", i, of}, [&] {
                        if (i >= most) throw InputError("killed");
                        ++made;
                        return Numbers{static_cast<std::uint32_t>(i * i)};
                    });
                    all[i] = part.at(0);
                },
                1);
        });
        return all;
    }
    auto squares(std::size_t of, std::size_t most)
    {
        made = 0;
        return run([&](Checkpoints& keeper) { return squares(keeper, of, most); });
    }
    /// Leaves all parts of an unfinished stage.
    void leave_parts()
    {
        const auto all_parts = [&](Checkpoints& keeper) {
            for (std::size_t i = 0; i < 20; ++i) {
                keeper.piece({"squares", i, 20},
                             [&] { return Numbers{static_cast<std::uint32_t>(i * i)}; });
            }
            return 0;
        };
        run(all_parts);
    }

    std::atomic<int> made = 0;
};

TEST_F(PiecesOfCheckpoints, AreNotRecomputed)
{
    EXPECT_EQ(refusal<InputError>([&] { squares(20, 15); }), "killed");
    const int before = made;
    const Numbers all = squares(20, 20);
    EXPECT_EQ(before + made, 20);
    EXPECT_EQ(all[19], 361U);
    EXPECT_THAT(log.notes, IsEmpty());
}

TEST_F(PiecesOfCheckpoints, AreRemovedWhenTheirStageIsSaved)
{
    leave_parts();
    EXPECT_EQ(folder.num_entries(), 22U);
    squares(20, 20);
    EXPECT_EQ(made, 0);
    EXPECT_EQ(folder.num_entries(), 3U); // lock, job, squares
}

TEST_F(PiecesOfCheckpoints, DependOnTheNumberOfParts)
{
    leave_parts();
    EXPECT_EQ(squares(10, 10).size(), 10U);
    EXPECT_EQ(made, 10);
}

TEST_F(PiecesOfCheckpoints, AreRecomputedIfDamagedWithANoteAtTheEnd)
{
    leave_parts();
    damage("squares-3-of-20.stage");
    EXPECT_EQ(squares(20, 20)[3], 9U);
    EXPECT_EQ(made, 1);
    ASSERT_EQ(log.notes.size(), 1U);
    EXPECT_THAT(log.notes[0], HasSubstr("squares-3-of-20.stage: it"));
    EXPECT_THAT(log.notes[0], HasSubstr("; it is computed again"));
}

} // namespace vcarve::checkpoints_test
