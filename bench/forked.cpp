#include "forked.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

namespace vcarve::bench {

namespace {

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
    // Buffers of streams are the parent's to write
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

} // namespace vcarve::bench
