#pragma once

#include "compare/compare.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::cli {

/// How another program ended, and what it took.
struct ChildOutcome {
    RunCost cost;            ///< of the program and the ones it started and waited for
    bool timed_out = false;  ///< it was killed, with the ones it started
    bool succeeded = false;  ///< it ended by itself with exit code 0
    std::string description; ///< how it ended, to be read after its name: "ended with exit code 1"
};

/// Runs a program, found along PATH where `words[0]` names no folder, in a process group of its
/// own, with nothing on stdin and all it prints in the file `printed`. Past `timeout_s` seconds the
/// group is killed. The program is told to end (SIGTERM) where this process ends first. Call it
/// while this process is small: the system counts the memory of the caller at the start as the
/// program's.
ChildOutcome run_child(std::vector<std::string> words, const std::filesystem::path& printed,
                       double timeout_s);

} // namespace vcarve::cli
