#pragma once

#include <array>
#include <csignal>

namespace vcarve {

/// The signals that request a process to end.
inline constexpr std::array kEndingSignals = {SIGINT, SIGTERM, SIGHUP};

/// Restores default signal handling in a child process: in the background or under nohup the tests
/// ignore signals, and children inherit this. Safe between fork and exec.
inline void take_signals_as_usual()
{
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kEndingSignals) {
        std::signal(signal, SIG_DFL);
        sigaddset(&signals, signal);
    }
    sigprocmask(SIG_UNBLOCK, &signals, nullptr);
}

} // namespace vcarve
