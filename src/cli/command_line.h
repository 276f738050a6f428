#pragma once

#include "options/option.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// The end of a message about usage.
inline constexpr const char* kSeeHelp = " (see colmap-vcarve --help)";

/// A parsed command line; values are still text.
struct ParsedArguments {
    std::vector<std::string> typed;             ///< all words
    std::vector<std::string> operands;          ///< words that are no options, in order
    std::string named_output;                   ///< the last operand, if -o named it
    std::map<std::string, std::string> options; ///< by name; a flag's value is empty

    bool has(const std::string& name) const { return options.count(name) != 0; }
};

/// Parses a command line: --name value, --name=value, -h, -v, -- before operands that begin with a
/// dash. As in COLMAP, -i or --input_path may name the first operand, -o or --output_path the last.
/// The last of two equal options counts. Throws UsageError for an unknown option (with the nearest
/// name), a library-only option, a missing value, or a value given to a flag.
ParsedArguments parse_arguments(std::span<const std::string> words, const OptionList& options);

/// Sets the given options. Throws UsageError if a value has the wrong type or is out of range.
void read_options(const ParsedArguments& given, const OptionList& options);

/// The most similar candidate: the first that contains the word without its dashes, or the one with
/// the smallest edit distance, at most a third of the letters. Empty if there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The help of a command.
struct Manual {
    using Lines = std::vector<std::pair<std::string, std::string>>;

    std::string command;           ///< as typed: "colmap-vcarve", "colmap-vcarve compare"
    std::string operands;          ///< "MODEL OUT.ply"
    std::string summary;           ///< one sentence
    Lines examples;                ///< command line, meaning
    Lines operand_meanings;        ///< "MODEL", meaning
    std::vector<std::string> ends; ///< lines at the end
    OptionList options;
    std::shared_ptr<void> values; ///< owns the default values of `options`
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

/// The text of --help, at most 80 columns wide: usage, examples, and the first sentence of each
/// common option's help. With `all`, --help-all: the full help of all command-line options.
std::string help_text(const Manual& manual, bool all);

/// The options as Markdown: a table per heading, then tables of those for C++ and Python only.
std::string markdown_options(const Manual& manual);

} // namespace vcarve::cli
