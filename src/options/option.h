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

/// Who sets an option.
enum class OptionLevel {
    common,   ///< most users: --help lists it
    advanced, ///< some users: --help-all lists it
    library   ///< those who study the method: C++ and Python only, not the command line
};

/// The description of an option.
struct OptionInfo {
    std::string name;                    ///< kebab-case, without dashes
    std::string unit = {};               ///< "px", "deg", "views"; empty for a pure number
    std::string help = {};               ///< the first sentence is the line of --help
    double min = 0.0;                    ///< smallest number
    double max = kUnlimited;             ///< largest number
    std::vector<std::string> words = {}; ///< accepted instead of numbers or names, in the order of
                                         ///< an enum's values
    double word_value = 0.0;             ///< the number that the only word means
    OptionLevel level = OptionLevel::common;
};

/// One of an option's words, or three numbers instead.
struct WordOrVector {
    static constexpr int kNoWord = -1; ///< the numbers count

    int word = 0;                                     ///< index into the words, or kNoWord
    Eigen::Vector3d vector = Eigen::Vector3d::Zero(); ///< where there is no word
};

/// An enum's value as a number.
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

/// Bytes that are typed as "8G"; a path, for which no word stands; a word or any other name.
using OptionValue = std::variant<double*, int*, std::int64_t*, bool*, EnumValue, WordOrVector*,
                                 RegionChoice*, std::filesystem::path*, std::string*>;

/// A field of an options struct: heading, description and address of the value. The command line,
/// --help, range checks, the record of a run, the documents and Python use lists of these.
struct Option {
    std::string_view stage;
    OptionInfo info;
    OptionValue value;
};
using OptionList = std::vector<Option>;

/// Several lists as one.
OptionList joined(std::initializer_list<OptionList> lists);

/// Whether the option has no value on the command line.
bool is_flag(const Option& option);
/// The value in help texts: "N", "cut|strict", "auto|SIZE"; empty for a flag.
std::string placeholder(const Option& option);
/// The accepted values, to be read after "takes": "a whole number, 2 or more (views)".
std::string accepted(const Option& option);
/// "min: 1, max: 64", "min: 2"; empty if only the sign is restricted.
std::string range_text(const Option& option);
/// The current value as a user types it; "yes" or "no" for a flag.
std::string value_text(const Option& option);

/// Parses a value; sets a flag to yes. Throws UsageError for a value of the wrong kind or out of
/// range.
void set_value(const Option& option, const std::string& text);

/// Throws UsageError naming the first option whose value is out of its range, or no number.
void check_values(const OptionList& options);

} // namespace vcarve
