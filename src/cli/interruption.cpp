#include "cli/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
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

/// Like what follows, calls only functions that are safe in a handler: unlink, rmdir, write,
/// _exit.
void remove_files()
{
    for (const std::string& file : files_to_remove) {
        if (::unlink(file.c_str()) != 0) ::rmdir(file.c_str());
    }
}

void say(std::string_view text)
{
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void remove_and_exit(int signal)
{
    remove_files();
    // A progress bar may stand on the terminal's line.
    if (::isatty(STDERR_FILENO) != 0) say("\n");
    ::_exit(128 + signal);
}

extern "C" void remove_and_report(int signal)
{
    remove_files();
    const char number[] = {static_cast<char>('0' + signal / 10),
                           static_cast<char>('0' + signal % 10), '\0'};
    say("colmap-vcarve: internal error: stopped by signal ");
    say(number);
    say(", please report\n");
    ::_exit(1);
}

/// Leaves a signal alone that somebody else handles, as sanitizers do with crashes, or ignores, as
/// nohup does with SIGHUP.
void handle(int signal, void (*handler)(int))
{
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) return;
    action.sa_handler = handler;
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
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
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
