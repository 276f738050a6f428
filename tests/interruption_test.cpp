#include "cli/interruption.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace vcarve::cli {
namespace {

/// The exit code of a process that gets `signal` while it writes `part`; -1 where the signal killed
/// it.
int exit_code_of(int signal, const std::filesystem::path& part)
{
    const pid_t child = ::fork();
    if (child == 0) {
        end_cleanly_on_signals({part, part.string() + "-never-begun"});
        std::raise(signal);
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(EndCleanlyOnSignals, RemovesWhatIsUnfinishedAndExitsWithTheSignalsCode)
{
    const TemporaryFolder folder;
    for (const auto& [signal, code] : {std::pair(SIGINT, 130), {SIGTERM, 143}, {SIGHUP, 129}}) {
        const auto part = folder.write("out.ply.part", "half of it");
        EXPECT_EQ(exit_code_of(signal, part), code);
        EXPECT_EQ(folder.num_entries(), 0U);
    }
}

#ifndef __SANITIZE_ADDRESS__ // which reports crashes itself
TEST(EndCleanlyOnSignals, MakesACrashAnInternalError)
{
    const TemporaryFolder folder;
    const auto part = folder.write("out.ply.part", "half of it");
    testing::internal::CaptureStderr();
    EXPECT_EQ(exit_code_of(SIGSEGV, part), 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "colmap-vcarve: internal error: stopped by signal 11, please report\n");
    EXPECT_EQ(folder.num_entries(), 0U);
}
#endif

TEST(EndCleanlyOnSignals, GoesOnWhereAPipeIsClosed)
{
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_of(SIGPIPE, folder.write("out.ply.part", "half of it")), 0);
    EXPECT_EQ(folder.num_entries(), 1U);
}

} // namespace
} // namespace vcarve::cli
