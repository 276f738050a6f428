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

/// What is said of an option, beside where its value is.
struct OptionInfo {
    std::string name;                    ///< kebab-case, without dashes
    std::string unit = {};               ///< "px", "deg", "views"; empty for a pure number
    std::string help = {};               ///< what it means and how to switch it off
    double min = 0.0;                    ///< of numbers, the smallest
    double max = kUnlimited;             ///< ... the largest
    std::vector<std::string> words = {}; ///< that may be typed instead of numbers or names, in the
                                         ///< order of an enum's values
    double word_value = 0.0;             ///< the number that the only word stands for
    bool tuning = false;                 ///< for those who study the method; --help leaves it out
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

/// A field of an options struct as a user sets it: the heading it stands under, what is said of
/// it, and where its value is. The command line, --help, the check of ranges, the record of a run
/// and the documents are all made from lists of these.
struct Option {
    std::string_view stage;
    OptionInfo info;
    OptionValue value;
};
using OptionList = std::vector<Option>;

/// Several lists as one.
OptionList joined(std::initializer_list<OptionList> lists);

/// Whether it is given without a value.
bool is_flag(const Option& option);
/// What stands for the value in texts: "<px>", "cut|strict", "auto|<size>"; empty for a flag.
std::string placeholder(const Option& option);
/// What is accepted, to be read after "takes": "a whole number, 2 or more (views)".
std::string accepted(const Option& option);
/// "1 to 64", "2 or more"; empty where only the sign is restricted.
std::string range_text(const Option& option);
/// The present value as one would type it; of a flag "yes" or "no".
std::string value_text(const Option& option);

/// Sets the value to what was typed; a flag's to yes. Throws UsageError where it is of the wrong
/// kind or out of its range.
void set_value(const Option& option, const std::string& text);

/// Throws UsageError naming the first option whose value is out of its range, or no number.
void check_values(const OptionList& options);

} // namespace vcarve
