#pragma once

#include "options/option.h"

#include <map>
#include <span>
#include <string>
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
/// The last of two equal options counts. Throws UsageError for an unknown option (naming the
/// nearest one), one of the library only, a missing value and a value given to a flag.
ParsedArguments parse_arguments(std::span<const std::string> words, const OptionList& options);

/// Sets the given options. Throws UsageError for a value of the wrong kind or out of range.
void read_options(const ParsedArguments& given, const OptionList& options);

/// The most similar candidate: the first that contains the word without its dashes, or the one with
/// the smallest edit distance, at most a third of the letters. Empty if there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

} // namespace vcarve::cli
