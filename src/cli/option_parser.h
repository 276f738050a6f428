#pragma once

#include "options/option.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace vcarve::cli {

/// Ends the message of an error that --help would have spared.
inline constexpr const char* kSeeHelp = " (see colmap-vcarve --help)";

/// A command line taken apart, values still as they were typed.
struct ParsedArguments {
    std::vector<std::string> typed;             ///< all of it, as it was
    std::vector<std::string> operands;          ///< what is no option, in order
    std::map<std::string, std::string> options; ///< by name; a flag's value is empty

    bool has(const std::string& name) const { return options.count(name) != 0; }
};

/// Takes a command line apart: --name value, --name=value, -h, -v, -- before operands that begin
/// with a dash; the first operand may be named by -i or --input_path, the last by -o or
/// --output_path, as in COLMAP. Where an option is given twice the last one counts. Throws
/// UsageError for an option that is not in `options` (naming the nearest one), a value that is
/// missing and a value given to a flag.
ParsedArguments parse_arguments(std::span<const std::string> words, const OptionList& options);

/// Sets the options that were given, and leaves all others as they are. Throws UsageError for a
/// value of the wrong kind or outside its range.
void read_options(const ParsedArguments& given, const OptionList& options);

/// The candidate that `word` was most likely meant to be: the first that contains it, leaving out
/// its dashes, or the one with the fewest letters changed, at most a third of them. Empty where
/// none is.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

} // namespace vcarve::cli
