#include "processes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>

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

Json measure_program(const std::vector<std::string>& words)
{
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    const rusage usage = wait_for(start(words), words);
    const std::chrono::duration<double> took = Clock::now() - began;
    return {{"seconds", took.count()},
            {"cpu_seconds", seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)},
            {"peak_bytes", std::int64_t{1024} * usage.ru_maxrss}};
}

} // namespace vcarve::bench
