#pragma once

#include "base/numbers.h"
#include "vcarve/region.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vcarve {

/// The users of an option.
enum class OptionLevel {
    common,   ///< most users: --help lists it
    advanced, ///< some users: --help-all lists it
    library   ///< studies of the method: C++ and Python only, not the command line
};

/// The description of an option.
struct OptionInfo {
    std::string name;                    ///< kebab-case, without dashes
    std::string unit = {};               ///< "px", "deg", "views"; empty for a pure number
    std::string help = {};               ///< --help shows the first sentence
    double min = 0.0;                    ///< smallest number
    double max = kUnlimited;             ///< largest number
    std::vector<std::string> words = {}; ///< words accepted instead of numbers or names; of an
                                         ///< enum, in the order of its values
    double word_value = 0.0;             ///< value of the word, if there is only one
    OptionLevel level = OptionLevel::common;
};

/// One of an option's words, or three numbers.
struct WordOrVector {
    static constexpr int kNoWord = -1; ///< `vector` is the value

    int word = 0;                                     ///< index into the words, or kNoWord
    Eigen::Vector3d vector = Eigen::Vector3d::Zero(); ///< unused if there is a word
};

/// Reads and writes an enum's value as a number.
struct EnumValue {
    std::function<int()> get;
    std::function<void(int)> set;
};

template <typename Enum>
EnumValue value_of_enum(Enum& value)
{
    return {[&value] { return static_cast<int>(value); },
            [&value](int number) { value = static_cast<Enum>(number); }};
}

/// int64: bytes, typed as "8G". path: has no words. string: a word or any other name.
using OptionValue = std::variant<double*, int*, std::int64_t*, bool*, EnumValue, WordOrVector*,
                                 RegionChoice*, std::filesystem::path*, std::string*>;

/// A field of an options struct: heading, description and address of the value. Parser, --help,
/// range checks, run record, docs/options.md and Python use lists of options.
struct Option {
    std::string_view stage;
    OptionInfo info;
    OptionValue value;
};
using OptionList = std::vector<Option>;

/// Concatenates lists.
OptionList joined(std::initializer_list<OptionList> lists);

/// The option with this kebab-case name, or this name in version 0.2; null if there is none.
const Option* find_option(std::string_view name, const OptionList& options);

/// Whether the option has no value on the command line.
bool is_flag(const Option& option);
/// The value in help texts: "N", "cut|strict", "auto|SIZE"; empty for a flag.
std::string placeholder(const Option& option);
/// The accepted values, as a phrase after "takes": "a whole number, 2 or more (views)".
std::string accepted(const Option& option);
/// The range: "min: 1, max: 64", "min: 2"; empty if only the sign is restricted.
std::string range_text(const Option& option);
/// The current value as a user types it; "yes" or "no" for a flag.
std::string value_text(const Option& option);

/// Parses a value; sets a flag to yes. Throws UsageError if the value has the wrong type or is out
/// of range.
void set_value(const Option& option, const std::string& text);

/// Throws UsageError with the first option whose value is out of range or not a number.
void check_values(const OptionList& options);

} // namespace vcarve
