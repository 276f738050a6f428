#pragma once

#include "vcarve/region.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace vcarve {

/// The end of a range that has none.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// What is said once about an option, beside its field, and used everywhere: by the parser, --help,
/// the range check, the run's record and the README's table.
struct OptionInfo {
    const char* name;        ///< kebab-case, without dashes
    const char* unit = "";   ///< "px", "deg", "views", "x spacing"; empty for a pure number
    const char* help = "";   ///< what it means and how to switch it off, one or two sentences
    double min = 0.0;        ///< smallest value accepted (numbers and counts)
    double max = kUnlimited; ///< largest value accepted (numbers and counts)
    const char* word = "";   ///< accepted instead of a count or bytes, for `word_value`
    double word_value = 0.0; ///< what the word stands for
};

/// One of an option's words, or three numbers instead.
struct WordOrVector {
    static constexpr int kNoWord = -1; ///< the numbers count

    int word = 0;                                     ///< index into the words, or kNoWord
    Eigen::Vector3d vector = Eigen::Vector3d::Zero(); ///< where there is no word
};

/// Shown every option of an options struct, in order. An options struct has a member
/// `void visit(OptionVisitor&)`; the parser writes through the references, everybody else reads.
class OptionVisitor {
  public:
    virtual ~OptionVisitor() = default;

    /// The options that follow belong to this stage of the pipeline.
    virtual void stage(const char* title) = 0;
    /// A number in the range of `info`.
    virtual void number(double& value, const OptionInfo& info) = 0;
    /// A whole number in the range of `info`.
    virtual void count(int& value, const OptionInfo& info) = 0;
    /// Bytes of memory, typed as parse_byte_size takes them.
    virtual void bytes(std::int64_t& value, const OptionInfo& info) = 0;
    /// Yes or no.
    virtual void flag(bool& value, const OptionInfo& info) = 0;
    /// `value` is an index into `names`.
    virtual void choice(int& value, std::span<const char* const> names, const OptionInfo& info) = 0;
    /// One of `words`, or three finite numbers in the range of `info`, typed as "1,2.5,-3".
    virtual void word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                const OptionInfo& info) = 0;
    /// A part of space, typed as "none", "auto", "0,0,0,1,2.5,1" or the name of a file.
    virtual void region(RegionChoice& value, const OptionInfo& info) = 0;

    /// A choice whose value is an enum numbered from 0 in the order of `names`.
    template <typename Enum>
    requires std::is_enum_v<Enum>
    void choice(Enum& value, std::span<const char* const> names, const OptionInfo& info)
    {
        int index = static_cast<int>(value);
        choice(index, names, info);
        value = static_cast<Enum>(index);
    }
};

} // namespace vcarve
