#pragma once

#include <array>
#include <csignal>

namespace vcarve {

/// The signals that ask a process to end.
inline constexpr std::array kEndingSignals = {SIGINT, SIGTERM, SIGHUP};

/// To be called in a child: undoes what it inherits where the tests themselves run in the
/// background or under nohup, both of which ignore signals. Safe between fork and exec.
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
