#pragma once

#include <span>
#include <string>

namespace vcarve {

/// Runs the program on the words that follow its name. Results go to files, what it does to stderr,
/// and only what was asked for (--help, --version, tables of `compare`) to stdout. Throws
/// UsageError and InputError.
void run_command_line(std::span<const std::string> arguments);

} // namespace vcarve
