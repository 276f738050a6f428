#include "program_run.h"

#include "io/files/mapped_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

namespace vcarve::bench {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void become(std::vector<std::string> words)
{
    std::vector<char*> pointers(words.size() + 1, nullptr); // the last ends the list
    std::ranges::transform(words, pointers.begin(), [](std::string& word) { return word.data(); });
    ::execvp(pointers[0], pointers.data());
    ::_exit(127);
}

pid_t start(const std::vector<std::string>& words)
{
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) become(words);
    return child;
}

/// What the files in a folder take on disk. Files may come and go meanwhile.
std::int64_t bytes_on_disk(const fs::path& folder)
{
    constexpr std::int64_t kBlock = 512; // of stat, on every file system
    std::int64_t bytes = 0;
    std::error_code gone;
    for (fs::recursive_directory_iterator at(folder, gone), end; !gone && at != end;
         at.increment(gone)) {
        struct stat status = {};
        if (::lstat(at->path().c_str(), &status) == 0) bytes += kBlock * status.st_blocks;
    }
    return bytes;
}

/// Whether it has ended; what it used stays to be asked.
bool has_ended(pid_t child)
{
    siginfo_t state = {};
    ::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOHANG | WNOWAIT);
    return state.si_pid == child;
}

/// What a process moved, as /proc tells of it until it is waited for.
std::map<std::string, std::int64_t> traffic_of(pid_t process)
{
    std::map<std::string, std::int64_t> traffic;
    std::ifstream file(fmt::format("/proc/{}/io", process));
    std::string name;
    std::int64_t bytes = 0;
    while (file >> name >> bytes) {
        traffic[name] = bytes;
    }
    return traffic;
}

double seconds_of(const timeval& time)
{
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

rusage wait_for(pid_t child, const std::vector<std::string>& words)
{
    int status = 0;
    rusage usage = {};
    ::wait4(child, &status, 0, &usage);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(
            fmt::format("{} ended with {} {}", fmt::join(words, " "),
                        WIFEXITED(status) ? "exit code" : "signal",
                        WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)));
    }
    return usage;
}

} // namespace

Json measure_program(const std::vector<std::string>& words, const std::filesystem::path& scratch)
{
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kBetweenLooks(20);
    const auto began = Clock::now();
    const pid_t child = start(words);
    std::int64_t scratch_bytes = 0;
    while (!has_ended(child)) {
        scratch_bytes = std::max(scratch_bytes, bytes_on_disk(scratch));
        std::this_thread::sleep_for(kBetweenLooks);
    }
    const std::chrono::duration<double> took = Clock::now() - began;
    const auto traffic = traffic_of(child);
    const auto moved = [&](const char* asked, const char* disk) {
        const auto bytes = [&](const char* name) {
            const auto found = traffic.find(name);
            return found != traffic.end() ? found->second : 0;
        };
        return std::max(bytes(asked), bytes(disk));
    };
    const rusage usage = wait_for(child, words);
    return {{"seconds", took.count()},
            {"cpu_seconds", seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)},
            {"peak_bytes", std::int64_t{1024} * usage.ru_maxrss},
            {"scratch_bytes", scratch_bytes},
            {"written_bytes", moved("wchar:", "write_bytes:")},
            {"read_bytes", moved("rchar:", "read_bytes:")}};
}

std::string megabytes(const Json& figures, const char* name)
{
    return fmt::format("{:.0f}", 1e-6 * figures[name].get<double>());
}

bool have_same_bytes(const fs::path& a, const fs::path& b)
{
    const MappedFile first(a);
    const MappedFile second(b);
    return std::ranges::equal(first.bytes(), second.bytes());
}

} // namespace vcarve::bench
