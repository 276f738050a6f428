// Runs of the program in which a system call fails: the disk is full or broken, memory is short, or
// no file can be opened. Each run ends with one sentence, and the mesh file is the old one or the
// complete new one.
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

namespace vcarve::failing_calls_test {
namespace {

namespace fs = std::filesystem;

/// The call that fails. From run to run, the number of the failing call increases by `step`.
struct Failing {
    const char* call;
    const char* continues; ///< "+" if all later calls fail, too
    int step;
    int points = 60;
    int least = 3; ///< minimum number of runs with a failing call
};

class ProgramWithFailing : public ::testing::TestWithParam<Failing> {
  protected:
    ProgramWithFailing()
    {
        write_ball_model(folder / "ball", GetParam().points, Eigen::Vector3d::Zero(), 0.05);
    }

    /// The command line of a run. It writes only into separate folders.
    std::vector<std::string> words() const
    {
        return program_with({folder / "ball", made / "out.ply", "--threads", "2", "--stats",
                             made / "stats.json", "--tile-points", "40", "--work",
                             folder / "work"});
    }
    /// The outcome of a run in which the n-th call fails; nothing if there are fewer calls.
    std::optional<Outcome> run(int n) const
    {
        fs::remove(mark);
        fs::remove_all(folder / "work");
        std::vector<std::string> all = {
            "/usr/bin/env", "LD_PRELOAD=" + failing_calls_library(), "VCARVE_FAILED=" + mark,
            fmt::format("VCARVE_FAILS={}:{}{}", GetParam().call, n, GetParam().continues)};
        const std::vector<std::string> program = words();
        all.insert(all.end(), program.begin(), program.end());
        const Outcome outcome = Subprocess(all).wait();
        return fs::exists(mark) ? std::optional(outcome) : std::nullopt;
    }

    TemporaryFolder folder;
    TemporaryFolder made;
    std::string mark = folder / "failed";
};

void expect_sentence(const Outcome& outcome)
{
    EXPECT_THAT(outcome.exit_code, ::testing::AnyOf(0, 1, 2, 3));
    EXPECT_THAT(outcome.err, ::testing::Not(::testing::HasSubstr("internal error")));
    if (outcome.exit_code == 0) return;
    EXPECT_THAT(outcome.err, ::testing::ContainsRegex("(^|\n)colmap-vcarve: [^\n]+\n$"));
}

} // namespace

TEST_P(ProgramWithFailing, EndsWithASentenceAndTheOldOrTheNewMesh)
{
    ASSERT_EQ(Subprocess(words()).wait().exit_code, 0);
    const std::string whole = bytes_of(made / "out.ply");
    int count = 0;
    for (int n = 1;; n += GetParam().step) {
        const auto out = made.write("out.ply", "old");
        const auto outcome = run(n);
        if (!outcome) break;
        ++count;
        const testing::ScopedTrace trace(__FILE__, __LINE__,
                                         fmt::format("{} {}", GetParam().call, n));
        expect_sentence(*outcome);
        const std::string bytes = bytes_of(out);
        EXPECT_TRUE(bytes == whole || (bytes == "old" && outcome->exit_code != 0));
        for (const auto& file : fs::directory_iterator(made.path())) {
            EXPECT_THAT(file.path().filename(),
                        ::testing::AnyOf("out.ply", "stats.json", "page.html"));
        }
        if (HasFailure()) break;
    }
    EXPECT_GE(count, GetParam().least);
}

INSTANTIATE_TEST_SUITE_P(Calls, ProgramWithFailing,
                         ::testing::Values(Failing{"write", "", 2}, Failing{"write", "+", 3},
                                           Failing{"rename", "", 1}, Failing{"fsync", "", 1},
                                           Failing{"mmap", "", 1}, Failing{"open", "", 3},
                                           Failing{"malloc", "", 199}),
                         [](const auto& made) {
                             return std::string(made.param.call) +
                                    (*made.param.continues == '\0' ? "" : "AndAllLater");
                         });

} // namespace vcarve::failing_calls_test
