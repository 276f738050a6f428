#include "cli/child_process.h"

#include "cli/process_usage.h"
#include "vcarve/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace vcarve::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kNotStarted = 127; ///< the exit code shells use, too
constexpr std::chrono::milliseconds kPollInterval(2);

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// In the child, between fork and exec, where only calls that are safe in signal handlers may be
/// made.
[[noreturn]] void become(char** words, const char* printed)
{
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::signal(SIGPIPE, SIG_DFL);
    ::signal(SIGXFSZ, SIG_DFL);
    const int nothing = ::open("/dev/null", O_RDONLY);
    const int out = ::open(printed, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const bool ready = nothing >= 0 && out >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
                       ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(out, STDERR_FILENO) >= 0;
    if (ready) ::execvp(words[0], words);
    ::_exit(kNotStarted);
}

std::string description_of(int status)
{
    if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
    if (WEXITSTATUS(status) == kNotStarted) return "could not be started";
    return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

/// Waits for the child; true where it had to be killed.
bool wait_or_kill(pid_t child, double timeout_s, int& status, rusage& usage)
{
    const Clock::time_point start = Clock::now();
    while (::wait4(child, &status, WNOHANG, &usage) == 0) {
        if (seconds_since(start) > timeout_s) {
            ::kill(-child, SIGKILL);
            ::wait4(child, &status, 0, &usage);
            return true;
        }
        std::this_thread::sleep_for(kPollInterval);
    }
    return false;
}

} // namespace

ChildOutcome run_child(std::vector<std::string> words, const std::filesystem::path& printed,
                       double timeout_s)
{
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);

    const Clock::time_point start = Clock::now();
    const pid_t child = ::fork();
    if (child < 0) throw UsageError("no further process can be started");
    if (child == 0) become(pointers.data(), printed.c_str());
    ::setpgid(child, child); // whichever of the two comes first

    ChildOutcome outcome;
    int status = 0;
    rusage usage = {};
    outcome.timed_out = wait_or_kill(child, timeout_s, status, usage);
    outcome.cost = {.seconds = seconds_since(start),
                    .cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
                    .peak_memory_bytes = 1024 * static_cast<std::int64_t>(usage.ru_maxrss)};
    outcome.succeeded = !outcome.timed_out && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    outcome.description = description_of(status);
    return outcome;
}

} // namespace vcarve::cli
