#pragma once

#include "options/option.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// What the help of a command consists of.
struct Manual {
    using Lines = std::vector<std::pair<std::string, std::string>>;

    std::string command;           ///< as typed: "colmap-vcarve", "colmap-vcarve compare"
    std::string operands;          ///< "MODEL OUT.ply"
    std::string summary;           ///< one sentence
    Lines examples;                ///< command line, meaning
    Lines operand_meanings;        ///< "MODEL", meaning
    std::vector<std::string> ends; ///< lines at the end
    OptionList options;
    std::shared_ptr<void> values; ///< where the options' defaults are
};

/// The last line of every help.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 success, 1 internal error, 2 usage or output error, 3 input error.";

/// The options of every command.
struct HelpOptions {
    bool help = false;
    bool help_all = false;
    bool version = false;
};
OptionList options_of(HelpOptions& help);

/// --help, at most 80 columns: usage, examples, and the first sentence of each common option's
/// help. With `all`, --help-all: the whole help of all options that the command line has.
std::string help_text(const Manual& manual, bool all);

/// The options as Markdown: a table per heading, then one of the options for C++ and Python only.
std::string markdown_options(const Manual& manual);

} // namespace vcarve::cli
