#include "options/option.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>

namespace vcarve {

namespace {

/// An option name of version 0.2, accepted until version 0.4.
struct FormerName {
    std::string_view former;
    std::string_view now;
};

constexpr FormerName kFormerNames[] = {{"sights", "rays"},
                                       {"bundle-sights", "bundle-rays"},
                                       {"inferred-sights", "inferred-rays"},
                                       {"closing-vast", "rim-closing"},
                                       {"closing-seen", "half-seen"}};

namespace fs = std::filesystem;

template <typename... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>; // Clang 14 requires it

std::string bounded(std::string text, const OptionInfo& info)
{
    if (info.min > -kUnlimited && info.max < kUnlimited) {
        text += fmt::format(" from {} to {}", info.min, info.max);
    } else if (info.min > -kUnlimited) {
        text += fmt::format(", {} or more", info.min);
    } else if (info.max < kUnlimited) {
        text += fmt::format(", {} or less", info.max);
    }
    return info.unit.empty() ? text : fmt::format("{} ({})", text, info.unit);
}

/// Joins alternatives: "none, auto or a file".
std::string either(std::vector<std::string> words, const std::string& other)
{
    if (!other.empty()) words.push_back(other);
    const std::string last = words.back();
    words.pop_back();
    return words.empty() ? last : fmt::format("{} or {}", fmt::join(words, ", "), last);
}

bool means_word(double value, const OptionInfo& info)
{
    return !info.words.empty() && value == info.word_value;
}

bool is_in_range(double value, const OptionInfo& info)
{
    return value >= info.min && value <= info.max; // not for NaN
}

std::string number_text(auto value, const OptionInfo& info)
{
    return means_word(static_cast<double>(value), info) ? info.words.front()
                                                        : fmt::format("{}", value);
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

std::string vector_text(const WordOrVector& value, const OptionInfo& info)
{
    return value.word == WordOrVector::kNoWord
               ? fmt::format("{}", fmt::join(value.vector, ","))
               : info.words.at(static_cast<std::size_t>(value.word));
}

[[noreturn]] void refuse(const Option& option, std::string_view value)
{
    throw UsageError(
        fmt::format("--{} takes {}, not {}", option.info.name, accepted(option), value));
}

[[noreturn]] void refuse_text(const Option& option, std::string_view text)
{
    refuse(option, fmt::format("\"{}\"", text));
}

template <typename Number>
bool parse(std::string_view text, Number& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// Parses numbers separated by commas, without other characters.
bool parse_list(std::string_view text, std::span<double> numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t end = i + 1 < numbers.size() ? text.find(',') : text.size();
        if (end == std::string_view::npos || !parse(text.substr(0, end), numbers[i])) return false;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return true;
}

/// The index of `text` among the option's words; nothing if it is not one.
std::optional<int> word_index(const Option& option, std::string_view text)
{
    const auto& words = option.info.words;
    const auto word = std::ranges::find(words, text);
    if (word == words.end()) return std::nullopt;
    return static_cast<int>(word - words.begin());
}

/// The value of the word may be outside the range for typed numbers.
template <typename Number>
void set_number(const Option& option, Number& value, const std::string& text)
{
    if (word_index(option, text)) {
        value = static_cast<Number>(option.info.word_value);
        return;
    }
    if (!parse(text, value)) refuse_text(option, text);
    if (!is_in_range(static_cast<double>(value), option.info)) refuse(option, text);
}

void set_bytes(const Option& option, std::int64_t& value, const std::string& text)
{
    if (word_index(option, text)) {
        value = static_cast<std::int64_t>(option.info.word_value);
        return;
    }
    const auto size = parse_byte_size(text);
    if (!size) refuse_text(option, text);
    value = *size;
}

void set_vector(const Option& option, WordOrVector& value, const std::string& text)
{
    value.word = word_index(option, text).value_or(WordOrVector::kNoWord);
    const bool is_vector = value.word == WordOrVector::kNoWord;
    if (is_vector && !parse_list(text, {value.vector.data(), 3})) refuse_text(option, text);
}

/// Parses a region. A text that begins with a number and a comma is a box.
RegionChoice parse_region(const Option& option, const std::string& text)
{
    RegionChoice region;
    if (const auto word = word_index(option, text)) {
        region.kind = *word == 0 ? RegionChoice::Kind::everything : RegionChoice::Kind::looked_at;
        return region;
    }
    double first = 0.0;
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || !parse(std::string_view(text).substr(0, comma), first)) {
        region.kind = RegionChoice::Kind::file;
        region.file = text;
        return region;
    }
    std::array<double, 6> numbers{};
    if (!parse_list(text, numbers)) refuse_text(option, text);
    region.kind = RegionChoice::Kind::box;
    region.low = Eigen::Vector3d(numbers.data());
    region.high = Eigen::Vector3d(numbers.data() + 3);
    return region;
}

void check_number(const Option& option, auto value)
{
    const auto number = static_cast<double>(value);
    if (means_word(number, option.info) || is_in_range(number, option.info)) return;
    refuse(option, fmt::format("{}", value));
}

void check_word(const Option& option, int word)
{
    const std::size_t words = option.info.words.size();
    if (word >= 0 && static_cast<std::size_t>(word) < words) return;
    throw UsageError(
        fmt::format("--{} has {} choices; {} is not one of them", option.info.name, words, word));
}

void check_vector(const Option& option, const WordOrVector& value)
{
    if (value.word != WordOrVector::kNoWord) return check_word(option, value.word);
    for (const double coordinate : value.vector) {
        if (std::isfinite(coordinate) && is_in_range(coordinate, option.info)) continue;
        refuse(option, fmt::format("{}", coordinate));
    }
}

void check_region(const Option& option, const RegionChoice& region)
{
    const bool is_box = region.low.allFinite() && region.high.allFinite() &&
                        (region.low.array() < region.high.array()).all();
    if (region.kind == RegionChoice::Kind::box && !is_box) {
        throw UsageError(fmt::format("--{} takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and "
                                     "z0 < z1, not {}",
                                     option.info.name, region_text(region)));
    }
    if (region.kind == RegionChoice::Kind::file && region.file.empty()) refuse_text(option, "");
}

void check_value(const Option& option)
{
    std::visit(Overloaded{[&](const double* value) { check_number(option, *value); },
                          [&](const int* value) { check_number(option, *value); },
                          [&](const std::int64_t* value) { check_number(option, *value); },
                          [&](const EnumValue& value) { check_word(option, value.get()); },
                          [&](const WordOrVector* value) { check_vector(option, *value); },
                          [&](const RegionChoice* value) { check_region(option, *value); },
                          [](const auto*) {}},
               option.value);
}

} // namespace

OptionList joined(std::initializer_list<OptionList> lists)
{
    OptionList all;
    for (const OptionList& list : lists) {
        all.insert(all.end(), list.begin(), list.end());
    }
    return all;
}

const Option* find_option(std::string_view name, const OptionList& options)
{
    const auto* const former = std::ranges::find(kFormerNames, name, &FormerName::former);
    const std::string_view current = former == std::ranges::end(kFormerNames) ? name : former->now;
    const auto option = std::ranges::find_if(
        options, [&](const Option& candidate) { return candidate.info.name == current; });
    return option == options.end() ? nullptr : &*option;
}

bool is_flag(const Option& option)
{
    return std::holds_alternative<bool*>(option.value);
}

std::string placeholder(const Option& option)
{
    if (is_flag(option)) return "";
    std::string unit; // "file or scale" is shown as FILE|SCALE
    for (const char letter : option.info.unit) {
        unit += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    }
    const std::size_t either = std::min(unit.find(" OR "), unit.size());
    if (either < unit.size()) unit = unit.substr(0, either) + "|" + unit.substr(either + 4);
    const std::string other =
        std::visit(Overloaded{[](const std::int64_t*) -> std::string { return "SIZE"; },
                              [](const EnumValue&) -> std::string { return ""; },
                              [](const WordOrVector*) -> std::string { return "X,Y,Z"; },
                              [](const RegionChoice*) -> std::string { return "BOX|FILE"; },
                              [&](const fs::path*) { return unit.empty() ? "FILE" : unit; },
                              [&](const std::string*) { return unit.empty() ? "NAME" : unit; },
                              [](const auto*) -> std::string { return "N"; }},
                   option.value);
    std::vector<std::string> all = option.info.words;
    if (!other.empty()) all.push_back(other);
    return fmt::format("{}", fmt::join(all, "|"));
}

std::string accepted(const Option& option)
{
    const OptionInfo& info = option.info;
    return std::visit(
        Overloaded{[&](const double*) { return either(info.words, bounded("a number", info)); },
                   [&](const int*) { return either(info.words, bounded("a whole number", info)); },
                   [&](const std::int64_t*) {
                       return either(info.words, "a size in bytes, or with K, M or G as in 8G");
                   },
                   [](const bool*) { return std::string(); },
                   [&](const EnumValue&) { return either(info.words, ""); },
                   [&](const WordOrVector*) { return bounded(either(info.words, "x,y,z"), info); },
                   [&](const RegionChoice*) {
                       return fmt::format("{}, x0,y0,z0,x1,y1,z1 or a file",
                                          fmt::join(info.words, ", "));
                   },
                   [](const fs::path*) { return std::string("a path"); },
                   [&](const std::string*) {
                       return either(info.words, "a " + (info.unit.empty() ? "name" : info.unit));
                   }},
        option.value);
}

std::string range_text(const Option& option)
{
    const OptionInfo& info = option.info;
    std::vector<std::string> ends;
    if (info.min > -kUnlimited && info.min != 0.0) ends.push_back(fmt::format("min: {}", info.min));
    if (info.max < kUnlimited) ends.push_back(fmt::format("max: {}", info.max));
    return fmt::format("{}", fmt::join(ends, ", "));
}

std::string value_text(const Option& option)
{
    const OptionInfo& info = option.info;
    return std::visit(
        Overloaded{[&](const double* value) { return number_text(*value, info); },
                   [&](const int* value) { return number_text(*value, info); },
                   [&](const std::int64_t* value) {
                       return means_word(static_cast<double>(*value), info)
                                  ? info.words.front()
                                  : byte_size_text(*value);
                   },
                   [](const bool* value) { return std::string(*value ? "yes" : "no"); },
                   [&](const EnumValue& value) {
                       return info.words.at(static_cast<std::size_t>(value.get()));
                   },
                   [&](const WordOrVector* value) { return vector_text(*value, info); },
                   [](const RegionChoice* value) { return region_text(*value); },
                   [](const fs::path* value) { return value->string(); },
                   [](const std::string* value) { return *value; }},
        option.value);
}

void set_value(const Option& option, const std::string& text)
{
    std::visit(Overloaded{[&](double* value) { set_number(option, *value, text); },
                          [&](int* value) { set_number(option, *value, text); },
                          [&](std::int64_t* value) { set_bytes(option, *value, text); },
                          [](bool* value) { *value = true; },
                          [&](const EnumValue& value) {
                              const auto word = word_index(option, text);
                              if (!word) refuse_text(option, text);
                              value.set(*word);
                          },
                          [&](WordOrVector* value) { set_vector(option, *value, text); },
                          [&](RegionChoice* value) { *value = parse_region(option, text); },
                          [&](auto* value) { *value = text; }},
               option.value);
    check_value(option);
}

void check_values(const OptionList& options)
{
    for (const Option& option : options) {
        check_value(option);
    }
}

} // namespace vcarve
