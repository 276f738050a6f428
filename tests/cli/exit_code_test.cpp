#include "cli/exit_code.h"
#include "io/files/mapped_file.h"
#include "support/temporary_folder.h"
#include "support/usual_signals.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string>

namespace vcarve::cli::exit_code_test {
namespace {

/// The exit code of a process that gets `signal` while it writes `part`; -1 if the signal killed
/// it. Signals have default handlers, except that `ignored` is ignored, as nohup ignores SIGHUP.
int exit_code_of(int signal, const std::filesystem::path& part, int ignored = 0)
{
    const pid_t child = ::fork();
    if (child == 0) {
        take_signals_as_usual();
        if (ignored != 0) std::signal(ignored, SIG_IGN);
        end_cleanly_on_signals({part, part.string() + "-never-begun"});
        std::raise(signal);
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(EndCleanlyOnSignals, RemovesPartialFilesAndExitsWithTheSignalsCode)
{
    const TemporaryFolder folder;
    for (const auto& [signal, code] : {std::pair(SIGINT, 130), {SIGTERM, 143}, {SIGHUP, 129}}) {
        const auto part = folder.write("out.ply.part", "half of it");
        EXPECT_EQ(exit_code_of(signal, part), code);
        EXPECT_EQ(folder.num_entries(), 0U);
    }
}

TEST(EndCleanlyOnSignals, KeepsIgnoringSignalsThatWereIgnoredAtTheStart)
{
    const TemporaryFolder folder;
    const auto part = folder.write("out.ply.part", "half of it");
    for (const int signal : kEndingSignals) {
        EXPECT_EQ(exit_code_of(signal, part, signal), 0);
        EXPECT_EQ(folder.num_entries(), 1U);
    }
}

#ifndef VCARVE_WATCHES_MEMORY // AddressSanitizer reports crashes itself
TEST(EndCleanlyOnSignals, ReportsACrashAsAnInternalError)
{
    const TemporaryFolder folder;
    const auto part = folder.write("out.ply.part", "half of it");
    testing::internal::CaptureStderr();
    EXPECT_EQ(exit_code_of(SIGSEGV, part), 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "colmap-vcarve: internal error: stopped by signal 11; please report it\n");
    EXPECT_EQ(folder.num_entries(), 0U);
}

/// The exit code of a process that reads a mapped file after it was truncated.
int exit_code_of_reading(const std::filesystem::path& path)
{
    const pid_t child = ::fork();
    if (child == 0) {
        take_signals_as_usual();
        end_cleanly_on_signals({});
        const MappedFile file(path);
        if (::truncate(path.c_str(), 0) != 0) ::_exit(99);
        ::_exit(std::ranges::count(file.bytes(), 'x') == 0 ? 0 : 98);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(EndCleanlyOnSignals, ReportsAFileTruncatedWhileItIsRead)
{
    const TemporaryFolder folder;
    const auto path = folder.write("points3D.bin", std::string(100'000, 'x'));
    testing::internal::CaptureStderr();
    EXPECT_EQ(exit_code_of_reading(path), 3);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "colmap-vcarve: an input file was truncated while it was read, or a disk failed\n");
}
#endif

TEST(EndCleanlyOnSignals, IgnoresAClosedPipe)
{
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_of(SIGPIPE, folder.write("out.ply.part", "half of it")), 0);
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(EndCleanlyOnSignals, IgnoresTheSignalOfTheFileSizeLimit)
{
    const TemporaryFolder folder;
    EXPECT_EQ(exit_code_of(SIGXFSZ, folder.write("out.ply.part", "half of it")), 0);
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(HoldStandardStreams, ReservesTheirDescriptors)
{
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(STDIN_FILENO);
        ::close(STDERR_FILENO);
        open_standard_streams();
        const int opened = ::open("/dev/null", O_RDONLY);
        ::_exit(opened > STDERR_FILENO && ::write(STDERR_FILENO, "x", 1) < 0 ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

} // namespace
} // namespace vcarve::cli::exit_code_test
