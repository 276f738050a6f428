#pragma once

#include "options/option.h"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// What a user can read about one command. All texts the program prints about itself come from
/// here.
struct Manual {
    using Lines = std::vector<std::pair<std::string, std::string>>; ///< term, what it means

    std::string command;    ///< as typed: "colmap-vcarve", "colmap-vcarve compare"
    std::string operands;   ///< "MODEL OUT.ply"
    std::string summary;    ///< one sentence
    Lines examples;         ///< command line, what it does
    Lines operand_meanings; ///< "MODEL", what may stand there
    Lines footnotes;        ///< "Exit code", what it says; other commands; ...
    OptionList options;
    std::shared_ptr<void> values; ///< where the options' defaults are
};

/// What every command has.
struct HelpOptions {
    bool help = false;
    bool help_all = false;
    bool version = false;
};
OptionList options_of(HelpOptions& help);

/// The default as one would type it; empty for a flag, and where there is none.
std::string default_text(const Option& option);

/// --help: at most 80 columns, options grouped by stage with default, unit and range; --help-all
/// has those for tuning, too.
std::string help_text(const Manual& manual, bool with_tuning);

/// The options as Markdown tables, one a stage, those for tuning last.
std::string markdown_options(const Manual& manual);

/// The man page of the program with all its commands, the bare form first, in roff.
std::string man_page(std::span<const Manual> manuals, const std::string& version);

/// A bash completion script: options, their choices, files where a path is taken.
std::string bash_completion(std::span<const Manual> manuals);

} // namespace vcarve::cli
