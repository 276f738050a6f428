#include "cli/exit_code.h"

#include "base/text.h"
#include "base/threads.h"
#include "vcarve/error.h"

#include <dirent.h>
#include <fcntl.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

namespace vcarve::cli {

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): handlers get no arguments
std::atomic<bool> memory_is_short = false;

[[noreturn]] void refuse_memory()
{
    memory_is_short = true;
    throw std::bad_alloc();
}

/// Ends the program if memory runs out where exceptions cannot propagate (standard library).
[[noreturn]] void end_without_exception()
{
    if (!memory_is_short) std::abort();
    remove_unfinished();
    std::fputs("colmap-vcarve: out of memory\n", stderr);
    ::_exit(1);
}

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr int kCrashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/// Global, because signal handlers get no user data. Written only while signals are blocked.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
std::vector<std::string> files_to_remove;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
std::atomic_flag is_reporting;

/// Writes to stderr. Async-signal-safe, like the two handlers below.
void say(std::string_view text)
{
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

/// Removes a folder and its files. opendir() is not async-signal-safe.
void remove_folder(const char* path)
{
    for (int tries = 0; tries < 3 && ::rmdir(path) != 0; ++tries) { // threads may still add files
        const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0) return;
        alignas(dirent64) std::array<char, 4096> entries;
        for (;;) {
            const ssize_t bytes = ::getdents64(folder, entries.data(), entries.size());
            if (bytes <= 0) break;
            for (ssize_t at = 0; at < bytes;) {
                const auto* entry = reinterpret_cast<const dirent64*>(entries.data() + at);
                ::unlinkat(folder, entry->d_name, 0); // fails for . and ..
                at += entry->d_reclen;
            }
        }
        ::close(folder);
    }
}

extern "C" void remove_and_exit(int signal, siginfo_t*, void*)
{
    remove_unfinished();
    // The current line of the terminal may show a progress bar.
    if (::isatty(STDERR_FILENO) != 0) say("\n");
    ::_exit(128 + signal);
}

extern "C" void remove_and_report(int signal, siginfo_t* info, void*)
{
    // Another thread is reporting already.
    while (is_reporting.test_and_set()) {
        ::pause();
    }
    remove_unfinished();
    if (signal == SIGBUS && info->si_code == BUS_ADRERR) {
        say("colmap-vcarve: an input file was truncated while it was read, or a disk failed\n");
        ::_exit(3);
    }
    const char number[] = {static_cast<char>('0' + signal / 10),
                           static_cast<char>('0' + signal % 10), '\0'};
    say("colmap-vcarve: internal error: stopped by signal ");
    say(number);
    say("; please report it\n");
    ::_exit(1);
}

/// Sets a handler, but keeps other handlers (sanitizers) and ignored signals (SIGHUP under nohup).
void handle(int signal, void (*handler)(int, siginfo_t*, void*))
{
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) return;
    action.sa_sigaction = handler;
    action.sa_flags = SA_SIGINFO;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

} // namespace

Ending ending_of(const std::function<void()>& main)
{
    std::set_new_handler(refuse_memory);
    std::set_terminate(end_without_exception);
    try {
        main();
        return {};
    } catch (const UsageError& error) {
        return {2, error.what()};
    } catch (const InputError& error) {
        return {3, error.what()};
    } catch (const std::bad_alloc&) {
        return {1, ""}; // without text, which could need memory
    } catch (const std::exception& error) {
        return {1, std::string("internal error: ") + error.what() + "; please report it"};
    } catch (...) {
        return {1, "internal error of an unknown type; please report it"};
    }
}

int report(const Ending& ending)
{
    if (ending.exit_code == 0) return 0;
    std::fputs("colmap-vcarve: ", stderr);
    std::fputs(ending.sentence.empty() ? "out of memory" : control_free(ending.sentence).c_str(),
               stderr);
    std::fputs("\n", stderr);
    return ending.exit_code;
}

void end_cleanly_on_signals(const std::vector<std::filesystem::path>& unfinished)
{
    sigset_t signals;
    sigset_t before;
    sigemptyset(&signals);
    for (const int signal : kSignals) {
        sigaddset(&signals, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals, &before);
    files_to_remove.assign(unfinished.begin(), unfinished.end());
    for (const int signal : kSignals) {
        handle(signal, remove_and_exit);
    }
    for (const int signal : kCrashes) {
        handle(signal, remove_and_report);
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void remove_unfinished()
{
    for (const std::string& file : files_to_remove) {
        if (::unlink(file.c_str()) != 0) remove_folder(file.c_str());
    }
}

void open_standard_streams()
{
    // open() returns the lowest free descriptor. It is read-only: writing still fails.
    int descriptor = 0;
    do {
        descriptor = ::open("/dev/null", O_RDONLY);
    } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
    if (descriptor > STDERR_FILENO) ::close(descriptor);
}

void limit_threads(int threads)
{
    // Never destroyed: after a failed allocation, oneTBB's destructor waits for ever for a lock.
    [[maybe_unused]] static auto* const limit =
        new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(threads_or_all(threads)));
}

} // namespace vcarve::cli
