#include "base/validate.h"

#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace vcarve {

namespace {

std::string accepted(std::string text, const OptionInfo& info)
{
    if (info.min > -kUnlimited && info.max < kUnlimited) {
        text += fmt::format(" from {} to {}", info.min, info.max);
    } else if (info.min > -kUnlimited) {
        text += fmt::format(", {} or more", info.min);
    } else if (info.max < kUnlimited) {
        text += fmt::format(", {} or less", info.max);
    }
    if (info.word[0] != '\0') text = fmt::format("{} or {}", info.word, text);
    return info.unit[0] == '\0' ? text : fmt::format("{} ({})", text, info.unit);
}

} // namespace

std::string accepted_numbers(const OptionInfo& info)
{
    return accepted("a number", info);
}

std::string accepted_counts(const OptionInfo& info)
{
    return accepted("a whole number", info);
}

std::string accepted_bytes(const OptionInfo& info)
{
    return info.word[0] == '\0' ? kAcceptedBytes
                                : fmt::format("{} or {}", info.word, kAcceptedBytes);
}

bool means_word(double value, const OptionInfo& info)
{
    return info.word[0] != '\0' && value == info.word_value;
}

std::string accepted_vectors(std::span<const char* const> words, const OptionInfo& info)
{
    return accepted(fmt::format("{} or x,y,z", fmt::join(words, ", ")), info);
}

std::string region_text(const RegionChoice& region)
{
    switch (region.kind) {
    case RegionChoice::Kind::everything:
        return "none";
    case RegionChoice::Kind::looked_at:
        return "auto";
    case RegionChoice::Kind::box:
        return fmt::format("{},{}", fmt::join(region.low, ","), fmt::join(region.high, ","));
    case RegionChoice::Kind::file:
        break;
    }
    return region.file.string();
}

void RangeCheck::number(double& value, const OptionInfo& info)
{
    // Not a number fails both comparisons.
    if (!(value >= info.min && value <= info.max)) {
        throw UsageError(
            fmt::format("--{} takes {}, not {}", info.name, accepted_numbers(info), value));
    }
}

void RangeCheck::count(int& value, const OptionInfo& info)
{
    if (means_word(value, info)) return;
    if (value < info.min || value > info.max) {
        throw UsageError(
            fmt::format("--{} takes {}, not {}", info.name, accepted_counts(info), value));
    }
}

void RangeCheck::bytes(std::int64_t& value, const OptionInfo& info)
{
    if (value < 0 && !means_word(static_cast<double>(value), info)) {
        throw UsageError(
            fmt::format("--{} takes {}, not {}", info.name, accepted_bytes(info), value));
    }
}

void RangeCheck::choice(int& value, std::span<const char* const> names, const OptionInfo& info)
{
    if (value < 0 || static_cast<std::size_t>(value) >= names.size()) {
        throw UsageError(fmt::format("--{} has {} choices, and {} is none of them", info.name,
                                     names.size(), value));
    }
}

void RangeCheck::word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                const OptionInfo& info)
{
    if (value.word != WordOrVector::kNoWord) return choice(value.word, words, info);
    for (const double coordinate : value.vector) {
        if (std::isfinite(coordinate) && coordinate >= info.min && coordinate <= info.max) continue;
        throw UsageError(fmt::format("--{} takes {}, not {}", info.name,
                                     accepted_vectors(words, info), coordinate));
    }
}

void RangeCheck::region(RegionChoice& value, const OptionInfo& info)
{
    const bool is_box = value.low.allFinite() && value.high.allFinite() &&
                        (value.low.array() < value.high.array()).all();
    if (value.kind == RegionChoice::Kind::box && !is_box) {
        throw UsageError(fmt::format("--{} takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and "
                                     "z0 < z1, not {}",
                                     info.name, region_text(value)));
    }
    if (value.kind == RegionChoice::Kind::file && value.file.empty()) {
        throw UsageError(fmt::format("--{} takes {}, not \"\"", info.name, kAcceptedRegions));
    }
}

} // namespace vcarve
