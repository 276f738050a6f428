#pragma once

#include "support/temporary_folder.h"
#include "support/usual_signals.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

namespace vcarve {

/// The exit code and the output of a program.
struct Outcome {
    int exit_code = -1; ///< -1 if a signal killed it
    std::string out;
    std::string err;
    double peak_memory_bytes = 0.0; ///< from the system, after the program ended
};

/// A program that runs in parallel to the test, without a terminal. The destructor kills it if it
/// still runs.
class Subprocess {
  public:
    /// `memory_limit` limits the address space, in bytes; 0 disables it.
    explicit Subprocess(std::vector<std::string> words, rlim_t memory_limit = 0)
    {
        std::vector<char*> pointers;
        for (std::string& word : words) {
            pointers.push_back(word.data());
        }
        pointers.push_back(nullptr);
        pid_ = ::fork();
        if (pid_ == 0) become(pointers.data(), memory_limit);
    }
    Subprocess(const Subprocess&) = delete;
    Subprocess& operator=(const Subprocess&) = delete;
    ~Subprocess()
    {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }

    void send(int signal) const { ::kill(pid_, signal); }
    std::string err_so_far() const { return bytes_of(folder_ / "err"); }
    bool is_running() const
    {
        siginfo_t state = {};
        ::waitid(P_PID, static_cast<id_t>(pid_), &state, WEXITED | WNOHANG | WNOWAIT);
        return state.si_pid == 0;
    }

    Outcome wait()
    {
        int status = 0;
        rusage usage = {};
        ::wait4(pid_, &status, 0, &usage);
        pid_ = 0;
        return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                .out = bytes_of(folder_ / "out"),
                .err = bytes_of(folder_ / "err"),
                .peak_memory_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss)};
    }

  private:
    [[noreturn]] void become(char** words, rlim_t memory_limit) const
    {
        take_signals_as_usual();
        ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
        ::dup2(::open((folder_ / "out").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open((folder_ / "err").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        const rlimit limit = {memory_limit, memory_limit};
        if (memory_limit > 0) ::setrlimit(RLIMIT_AS, &limit);
        ::execv(words[0], words);
        ::_exit(127);
    }

    TemporaryFolder folder_;
    pid_t pid_ = 0;
};

} // namespace vcarve
