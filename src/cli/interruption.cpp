#include "cli/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vcarve::cli {

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr int kCrashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/// What the handler may touch has to be global: it gets nothing but the signal's number. Written
/// only while the signals are blocked.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
std::vector<std::string> files_to_remove;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
std::atomic_flag is_reporting;

/// Like what follows, calls only functions that are safe in a handler: open, read, write, pause,
/// _exit.
void say(std::string_view text)
{
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

/// The line of /proc/self/maps that tells what is mapped at an address; empty where there is none.
/// A system call a byte, for nothing may be allocated.
std::string_view mapping_at(std::uintptr_t address, std::span<char> line)
{
    const int maps = ::open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
    std::size_t size = 0;
    for (char byte = 0; ::read(maps, &byte, 1) == 1;) {
        if (byte != '\n') {
            const bool is_control = static_cast<unsigned char>(byte) < ' ' || byte == 0x7F;
            line[size] = is_control ? '?' : byte;
            size = std::min(size + 1, line.size() - 1);
            continue;
        }
        std::uintptr_t begin = 0;
        std::uintptr_t end = 0;
        const char* const last = line.data() + size;
        const char* const dash = std::from_chars(line.data(), last, begin, 16).ptr;
        std::from_chars(std::min(dash + 1, last), last, end, 16);
        if (begin <= address && address < end) return {line.data(), size};
        size = 0;
    }
    return {};
}

/// Says which file of a name the system could not read at an address, if there is one.
bool say_unreadable(const void* address)
{
    std::array<char, 5000> line{}; // longer than the longest path
    const std::string_view mapping =
        mapping_at(reinterpret_cast<std::uintptr_t>(address), std::span(line));
    const std::size_t path = mapping.find('/');
    if (path == std::string_view::npos || mapping.ends_with(" (deleted)")) return false;
    say("colmap-vcarve: ");
    say(mapping.substr(path));
    say(": the file was shortened while it was read, or its disk fails\n");
    return true;
}

extern "C" void remove_and_exit(int signal, siginfo_t*, void*)
{
    remove_unfinished();
    // A progress bar may stand on the terminal's line.
    if (::isatty(STDERR_FILENO) != 0) say("\n");
    ::_exit(128 + signal);
}

extern "C" void remove_and_report(int signal, siginfo_t* info, void*)
{
    // Another thread reports.
    while (is_reporting.test_and_set()) {
        ::pause();
    }
    remove_unfinished();
    if (signal == SIGBUS && info->si_code == BUS_ADRERR && say_unreadable(info->si_addr)) {
        ::_exit(3);
    }
    const char number[] = {static_cast<char>('0' + signal / 10),
                           static_cast<char>('0' + signal % 10), '\0'};
    say("colmap-vcarve: internal error: stopped by signal ");
    say(number);
    say(", please report\n");
    ::_exit(1);
}

/// Leaves a signal alone that somebody else handles, as sanitizers do with crashes, or ignores, as
/// nohup does with SIGHUP.
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
        if (::unlink(file.c_str()) != 0) ::rmdir(file.c_str());
    }
}

void hold_standard_streams()
{
    // The lowest number that is free is given; writing to it fails, as it did.
    int descriptor = 0;
    do {
        descriptor = ::open("/dev/null", O_RDONLY);
    } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
    if (descriptor > STDERR_FILENO) ::close(descriptor);
}

} // namespace vcarve::cli
