#pragma once

#include "cli/manual.h"
#include "cli/option_parser.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vcarve::cli {

/// What a program can be told to do.
struct Command {
    std::string name; ///< first word of the command line; empty for the bare form
    std::function<Manual()> manual;
    std::function<void(const ParsedArguments&)> run;
};

/// Those of colmap-vcarve, the bare form first.
std::vector<Command> commands();

/// Runs a program that has these commands on the words that follow its name. Results go to files,
/// what it does to stderr, and only what was asked for (--help, --version, tables of `compare`) to
/// stdout. Throws UsageError and InputError.
void run_command_line(std::span<const std::string> arguments, std::span<const Command> commands);

} // namespace vcarve::cli
