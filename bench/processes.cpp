#include "processes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

namespace vcarve::bench {

namespace {

namespace fs = std::filesystem;

std::string answer_of(const std::function<Json()>& work)
{
    try {
        return Json{{"answer", work()}}.dump();
    } catch (const std::exception& error) {
        return Json{{"error", error.what()}}.dump();
    }
}

[[noreturn]] void be_child(int out, const std::function<Json()>& work)
{
    const std::string text = answer_of(work);
    std::size_t written = 0;
    while (written < text.size()) {
        const ssize_t count = ::write(out, text.data() + written, text.size() - written);
        if (count <= 0) break;
        written += static_cast<std::size_t>(count);
    }
    // Do not flush stream buffers: the parent writes them.
    ::_exit(written == text.size() ? 0 : 1);
}

std::string read_all(int in)
{
    std::string text;
    std::array<char, 4096> block{};
    ssize_t count = 0;
    while ((count = ::read(in, block.data(), block.size())) > 0) {
        text.append(block.data(), static_cast<std::size_t>(count));
    }
    return text;
}

[[noreturn]] void become(std::vector<std::string> words)
{
    std::vector<char*> pointers(words.size() + 1, nullptr); // terminated by nullptr
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

/// The disk space of the files in a folder. Files may appear and disappear meanwhile.
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

/// Whether a child has ended. Its resource usage stays available.
bool has_ended(pid_t child)
{
    siginfo_t state = {};
    ::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOHANG | WNOWAIT);
    return state.si_pid == child;
}

/// The bytes that a process read and wrote, from /proc. Call it before waiting for the process.
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

Json in_own_process(const std::function<Json()>& work)
{
    std::array<int, 2> pipe_ends{};
    if (::pipe(pipe_ends.data()) != 0) throw std::runtime_error("no pipe");
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
        ::close(pipe_ends[0]);
        be_child(pipe_ends[1], work);
    }
    ::close(pipe_ends[1]);
    const std::string text = read_all(pipe_ends[0]);
    ::close(pipe_ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(fmt::format("a measurement ended with status {}", status));
    }
    Json result = Json::parse(text);
    if (result.contains("error")) throw std::runtime_error(result["error"].get<std::string>());
    return result["answer"];
}

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

} // namespace vcarve::bench
