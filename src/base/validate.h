#pragma once

#include "vcarve/option_visitor.h"

#include <string>

namespace vcarve {

/// What an option accepts, to be read after "takes": "a whole number, 2 or more (views)", "a number
/// from 0 to 180 (deg)".
std::string accepted_numbers(const OptionInfo& info);
std::string accepted_counts(const OptionInfo& info);
/// "none, auto or x,y,z".
std::string accepted_vectors(std::span<const char* const> words, const OptionInfo& info);
inline constexpr const char* kAcceptedRegions = "none, auto, x0,y0,z0,x1,y1,z1 or a file";
inline constexpr const char* kAcceptedBytes = "a size in bytes, or with K, M or G as in 8G";

/// A size, or the option's word.
std::string accepted_bytes(const OptionInfo& info);

/// Whether a value is what the option's word stands for.
bool means_word(double value, const OptionInfo& info);

/// A region as one would type it.
std::string region_text(const RegionChoice& region);

/// Throws UsageError where a value of an option lies outside its range, or is not a number.
class RangeCheck final : public OptionVisitor {
  public:
    void stage(const char*) override {}
    void number(double& value, const OptionInfo& info) override;
    void count(int& value, const OptionInfo& info) override;
    void bytes(std::int64_t& value, const OptionInfo& info) override;
    void flag(bool&, const OptionInfo&) override {}
    void choice(int& value, std::span<const char* const> names, const OptionInfo& info) override;
    void word_or_vector(WordOrVector& value, std::span<const char* const> words,
                        const OptionInfo& info) override;
    void region(RegionChoice& value, const OptionInfo& info) override;
};

/// Throws UsageError naming the first option of `options` whose value is not accepted. For those
/// who fill an options struct themselves; the command line has been checked when it was parsed.
template <typename Options>
void validate(Options options)
{
    RangeCheck check;
    options.visit(check);
}

} // namespace vcarve
