// Runs of the program in which one call of the system fails, whichever it is: the disk is full or
// broken, the memory short, no file may be opened. Each ends with a sentence, and the surface is
// the old one or the whole new one.
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

/// Which call fails, and how many of them are left out between one run and the next.
struct Failing {
    const char* call;
    const char* goes_on; ///< "+" where all later ones fail, too
    int step;
    int points = 60;
    const char* blocks = "auto"; ///< with two, and many points, arrays are in files
    int least = 3;               ///< so many of these calls a run makes at least
};

class ProgramWithFailing : public ::testing::TestWithParam<Failing> {
  protected:
    ProgramWithFailing()
    {
        write_ball_model(folder / "ball", GetParam().points, Eigen::Vector3d::Zero(), 0.05);
    }

    /// All that a run writes goes into a folder of its own.
    std::vector<std::string> words() const
    {
        return program_with({folder / "ball", made / "out.ply", "--threads", "2", "--blocks",
                             GetParam().blocks, "--stats", made / "stats.json", "--report",
                             made / "page.html", "--work", folder / "work"});
    }
    /// Of a run in which the n-th call fails; nothing where there are not so many.
    std::optional<Outcome> run(int n) const
    {
        fs::remove(mark);
        fs::remove_all(folder / "work");
        std::vector<std::string> all = {
            "/usr/bin/env", "LD_PRELOAD=" + failing_calls_library(), "VCARVE_FAILED=" + mark,
            fmt::format("VCARVE_FAILS={}:{}{}", GetParam().call, n, GetParam().goes_on)};
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

TEST_P(ProgramWithFailing, EndsWithASentenceAndTheOldSurfaceOrTheNewOne)
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

INSTANTIATE_TEST_SUITE_P(
    Calls, ProgramWithFailing,
    ::testing::Values(Failing{"write", "", 2}, Failing{"write", "+", 3}, Failing{"rename", "", 1},
                      Failing{"fsync", "", 1}, Failing{"mmap", "", 1}, Failing{"open", "", 3},
                      Failing{"malloc", "", 199}, Failing{"fallocate", "", 1, 60'000, "2", 2}),
    [](const auto& made) {
        return std::string(made.param.call) + (*made.param.goes_on == '\0' ? "" : "AndAllLater");
    });

} // namespace vcarve::failing_calls_test
