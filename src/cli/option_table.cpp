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

} // namespace

OptionRow& OptionTable::add(OptionKind kind, const OptionInfo& info)
{
    OptionRow row;
    row.stage = stage_;
    row.kind = kind;
    row.name = info.name;
    row.unit = info.unit;
    row.help = info.help;
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
    row.initial = fmt::format("{}", value);
}

void OptionTable::bytes(std::int64_t& value, const OptionInfo& info)
{
    OptionRow& row = add(OptionKind::bytes, info);
    row.accepted = kAcceptedBytes;
    row.initial = byte_size_text(value);
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
    switch (row.kind) {
    case OptionKind::number:
    case OptionKind::count:
        return row.unit.empty() ? "<number>" : fmt::format("<{}>", row.unit);
    case OptionKind::bytes:
        return "<size>";
    case OptionKind::choice:
        return fmt::format("{}", fmt::join(row.choices, "|"));
    case OptionKind::vector:
        return fmt::format("{}|x,y,z", fmt::join(row.choices, "|"));
    case OptionKind::region:
        return fmt::format("{}|box|<file>", fmt::join(row.choices, "|"));
    case OptionKind::path:
        return "<file>";
    case OptionKind::name:
        return fmt::format("{}|<name>", fmt::join(row.choices, "|"));
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
