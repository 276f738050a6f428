#include "cli/option_table.h"

#include "base/byte_size.h"
#include "base/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace vcarve::cli {

namespace {

std::string range(const OptionInfo& info)
{
    if (info.max < kUnlimited) return fmt::format("{} to {}", info.min, info.max);
    if (info.min > 0.0) return fmt::format("{} or more", info.min);
    return "";
}

/// Words, and what may stand there instead of one.
std::string one_of(const std::string& words, const std::string& other)
{
    return words.empty() ? other : fmt::format("{}|{}", words, other);
}

} // namespace

OptionRow& OptionTable::add(OptionKind kind, const OptionInfo& info)
{
    OptionRow row;
    row.stage = stage_;
    row.kind = kind;
    row.name = info.name;
    row.unit = info.unit;
    row.help = info.help;
    if (info.word[0] != '\0') row.choices = {info.word};
    return rows_.emplace_back(row);
}

void OptionTable::number(double& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::number, info);
    row.accepted = accepted_numbers(info);
    row.range = range(info);
    row.initial = fmt::format("{}", value);
}

void OptionTable::count(int& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::count, info);
    row.accepted = accepted_counts(info);
    row.range = range(info);
    row.initial = means_word(value, info) ? info.word : fmt::format("{}", value);
}

void OptionTable::bytes(std::int64_t& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::bytes, info);
    row.accepted = accepted_bytes(info);
    const bool is_word = means_word(static_cast<double>(value), info);
    row.initial = is_word ? info.word : byte_size_text(value);
}

void OptionTable::flag(bool& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::flag, info);
    if (value) row.name = "no-" + row.name;
}

void OptionTable::choice(int& value, std::span<const char* const> names, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::choice, info);
    row.choices.assign(names.begin(), names.end());
    row.accepted = fmt::format("{}", fmt::join(row.choices, " or "));
    row.initial = row.choices.at(static_cast<std::size_t>(value));
}

void OptionTable::word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                 const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::vector, info);
    row.choices.assign(words.begin(), words.end());
    row.accepted = accepted_vectors(words, info);
    row.range = range(info);
    row.initial = value.word == WordOrVector::kNoWord
                      ? fmt::format("{}", fmt::join(value.vector, ","))
                      : row.choices.at(static_cast<std::size_t>(value.word));
}

void OptionTable::region(RegionChoice& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::region, info);
    row.choices = {"none", "auto"};
    row.accepted = kAcceptedRegions;
    row.initial = region_text(value);
}

void OptionTable::path(const OptionInfo& info)
{
    add(OptionKind::path, info).accepted = "a path";
}

void OptionTable::word_or_name(std::span<const char* const> words, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::name, info);
    row.choices.assign(words.begin(), words.end());
    row.accepted = fmt::format("{} or a name", fmt::join(row.choices, ", "));
    row.initial = row.choices.front();
}

std::string placeholder(const OptionRow& row)
{
    const std::string unit = row.unit.empty() ? "" : fmt::format("<{}>", row.unit);
    const std::string words = fmt::format("{}", fmt::join(row.choices, "|"));
    switch (row.kind) {
    case OptionKind::number:
    case OptionKind::count:
        return one_of(words, unit.empty() ? "<number>" : unit);
    case OptionKind::bytes:
        return one_of(words, "<size>");
    case OptionKind::choice:
        return words;
    case OptionKind::vector:
        return one_of(words, "x,y,z");
    case OptionKind::region:
        return one_of(words, "box|<file>");
    case OptionKind::path:
        return unit.empty() ? "<file>" : unit;
    case OptionKind::name:
        return one_of(words, "<name>");
    case OptionKind::flag:
        break;
    }
    return "";
}

const OptionRow* find_row(const std::vector<OptionRow>& rows, std::string_view name)
{
    const auto row = std::ranges::find(rows, name, &OptionRow::name);
    return row == rows.end() ? nullptr : &*row;
}

} // namespace vcarve::cli
