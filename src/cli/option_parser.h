#pragma once

#include "cli/option_table.h"
#include "vcarve/option_visitor.h"

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

/// Takes a command line apart: --name value, --name=value, -- before operands that begin with a
/// dash. Where an option is given twice the last one counts. Throws UsageError for an option that
/// is not in `rows` (naming the nearest one), a value that is missing and a value given to a flag.
ParsedArguments parse_arguments(std::span<const std::string> arguments,
                                const std::vector<OptionRow>& rows);

/// Writes the values that were given into options structs, and leaves all others as they are.
/// Throws UsageError for a value of the wrong kind or outside its range.
class OptionReader final : public OptionVisitor {
  public:
    explicit OptionReader(const ParsedArguments& given) : given_(given.options) {}

    void stage(const char*) override {}
    void number(double& value, const OptionInfo& info) override;
    void count(int& value, const OptionInfo& info) override;
    void bytes(std::int64_t& value, const OptionInfo& info) override;
    void flag(bool& value, const OptionInfo& info) override;
    void choice(int& value, std::span<const char* const> names, const OptionInfo& info) override;
    void word_or_vector(WordOrVector& value, std::span<const char* const> words,
                        const OptionInfo& info) override;
    void region(RegionChoice& value, const OptionInfo& info) override;

  private:
    const std::map<std::string, std::string>& given_;
};

/// The candidate that `word` was most likely meant to be: the first that contains it, leaving out
/// its dashes, or the one with the fewest letters changed, at most a third of them. Empty where
/// none is.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

} // namespace vcarve::cli
