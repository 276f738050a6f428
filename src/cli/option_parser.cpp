#include "cli/option_parser.h"

#include "base/byte_size.h"
#include "base/validate.h"
#include "vcarve/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>

namespace vcarve::cli {

namespace {

/// Levenshtein's distance: letters inserted, removed or replaced to get from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to)
{
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
        }
    }
    return row.back();
}

/// CLI11 splits the words; what the values mean is decided by OptionReader.
void declare(CLI::App& app, const std::vector<OptionRow>& rows)
{
    app.set_help_flag();
    app.allow_extras();
    for (const OptionRow& row : rows) {
        const std::string name = row.name == "help" ? "-h,--help" : "--" + row.name;
        CLI::Option* option = row.kind == OptionKind::flag
                                  ? app.add_flag(name)->disable_flag_override()
                                  : app.add_option(name);
        option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    }
}

/// Options that were called otherwise in 0.1.
struct RenamedOption {
    std::string_view before;
    std::string_view now;
};
constexpr RenamedOption kRenamedOptions[] = {
    {"--softness", "--distance-sigma"},
};

/// The option of `names` that a word most likely means; empty where there is none.
std::string likely_option(std::string_view word, const std::vector<std::string>& names)
{
    for (const RenamedOption& option : kRenamedOptions) {
        const bool is_here = std::ranges::find(names, option.now) != names.end();
        if (option.before == word && is_here) return std::string(option.now);
    }
    return nearest(word, names);
}

[[noreturn]] void refuse_unknown(std::string_view word, const std::vector<OptionRow>& rows)
{
    const std::string_view name = word.substr(0, word.find('='));
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const OptionRow& row : rows) {
        names.push_back("--" + row.name);
    }
    const std::string near = likely_option(name, names);
    throw UsageError(near.empty() ? fmt::format("there is no option {}{}", name, kSeeHelp)
                                  : fmt::format("there is no option {}; did you mean {}?{}", name,
                                                near, kSeeHelp));
}

/// What CLI11 could not place are the operands: a positional of CLI11's would take a path "[a,b]"
/// for a list. Before the first "--" nothing among them may look like an option.
std::vector<std::string> operands_of(const std::vector<std::string>& words,
                                     const std::vector<OptionRow>& rows)
{
    std::vector<std::string> operands;
    bool after_dashes = false;
    for (const std::string& word : words) {
        const bool is_mark = word == "--" && !after_dashes;
        const bool is_option = word.size() > 1 && word.front() == '-' && !after_dashes;
        after_dashes = after_dashes || is_mark;
        if (is_option && !is_mark) refuse_unknown(word, rows);
        if (!is_mark) operands.push_back(word);
    }
    return operands;
}

/// CLI11 found a value missing or given to a flag; its message begins with the option's name.
[[noreturn]] void refuse_mismatch(std::string_view message, const std::vector<OptionRow>& rows)
{
    std::string_view name = message.substr(0, message.find_first_of(": "));
    name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
    const OptionRow* row = find_row(rows, name);
    if (row == nullptr) throw UsageError(fmt::format("{}{}", message, kSeeHelp));
    if (row->kind == OptionKind::flag) throw UsageError(fmt::format("--{} takes no value", name));
    throw UsageError(fmt::format("--{} needs a value: {}", name, row->accepted));
}

template <typename Number>
bool parse(std::string_view text, Number& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// Numbers with commas between them, and nothing else.
bool parse_list(std::string_view text, std::span<double> numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t end = i + 1 < numbers.size() ? text.find(',') : text.size();
        if (end == std::string_view::npos || !parse(text.substr(0, end), numbers[i])) return false;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return true;
}

/// Whether a text is meant to be a list of numbers: it begins with one and a comma.
bool begins_a_list(std::string_view text)
{
    double number = 0.0;
    const std::size_t end = text.find(',');
    return end != std::string_view::npos && parse(text.substr(0, end), number);
}

[[noreturn]] void refuse_value(const char* name, std::string_view accepted, std::string_view text)
{
    throw UsageError(fmt::format("--{} takes {}, not \"{}\"", name, accepted, text));
}

} // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates)
{
    const std::string_view name = word.substr(std::min(word.find_first_not_of('-'), word.size()));
    std::string best;
    std::size_t fewest = word.size() / 3 + 1;
    for (const std::string& candidate : candidates) {
        if (name.size() >= 3 && candidate.find(name) != std::string::npos) return candidate;
        const std::size_t changes = edit_distance(word, candidate);
        if (changes < fewest) {
            fewest = changes;
            best = candidate;
        }
    }
    return best;
}

void OptionReader::number(double& value, const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    if (!parse(given->second, value)) {
        refuse_value(info.name, accepted_numbers(info), given->second);
    }
    RangeCheck().number(value, info);
}

void OptionReader::count(int& value, const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    if (info.word[0] != '\0' && given->second == info.word) {
        value = static_cast<int>(info.word_value);
        return;
    }
    // The number that the word stands for is no value that one could type.
    if (!parse(given->second, value) || means_word(value, info)) {
        refuse_value(info.name, accepted_counts(info), given->second);
    }
    RangeCheck().count(value, info);
}

void OptionReader::bytes(std::int64_t& value, const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    if (info.word[0] != '\0' && given->second == info.word) {
        value = static_cast<std::int64_t>(info.word_value);
        return;
    }
    const auto size = parse_byte_size(given->second);
    if (!size) refuse_value(info.name, accepted_bytes(info), given->second);
    value = *size;
}

void OptionReader::flag(bool& value, const OptionInfo& info)
{
    const std::string switched = (value ? "no-" : "") + std::string(info.name);
    if (given_.count(switched) != 0) value = !value;
}

void OptionReader::choice(int& value, std::span<const char* const> names, const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    const auto name = std::ranges::find(names, given->second);
    if (name == names.end()) {
        refuse_value(info.name, fmt::format("{}", fmt::join(names, " or ")), given->second);
    }
    value = static_cast<int>(name - names.begin());
}

void OptionReader::word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                  const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    const auto word = std::ranges::find(words, given->second);
    value.word =
        word == words.end() ? WordOrVector::kNoWord : static_cast<int>(word - words.begin());
    if (word == words.end() && !parse_list(given->second, {value.vector.data(), 3})) {
        refuse_value(info.name, accepted_vectors(words, info), given->second);
    }
    RangeCheck().word_or_vector(value, words, info);
}

void OptionReader::region(RegionChoice& value, const OptionInfo& info)
{
    const auto given = given_.find(info.name);
    if (given == given_.end()) return;
    const std::string& text = given->second;
    value = {};
    if (text == "none") return;
    if (text == "auto") {
        value.kind = RegionChoice::Kind::looked_at;
    } else if (begins_a_list(text)) {
        std::array<double, 6> numbers{};
        if (!parse_list(text, numbers)) refuse_value(info.name, kAcceptedRegions, text);
        value.kind = RegionChoice::Kind::box;
        value.low = Eigen::Vector3d(numbers.data());
        value.high = Eigen::Vector3d(numbers.data() + 3);
    } else {
        value.kind = RegionChoice::Kind::file;
        value.file = text;
    }
    RangeCheck().region(value, info);
}

ParsedArguments parse_arguments(std::span<const std::string> arguments,
                                const std::vector<OptionRow>& rows)
{
    CLI::App app;
    declare(app, rows);
    try {
        // CLI11 takes the words last to first.
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ArgumentMismatch& error) {
        refuse_mismatch(error.what(), rows);
    } catch (const CLI::ParseError& error) {
        throw UsageError(fmt::format("{}{}", error.what(), kSeeHelp));
    }
    ParsedArguments parsed;
    parsed.typed.assign(arguments.begin(), arguments.end());
    parsed.operands = operands_of(app.remaining(), rows);
    for (const OptionRow& row : rows) {
        const CLI::Option* option = app.get_option("--" + row.name);
        if (option->count() == 0) continue;
        const bool is_flag = row.kind == OptionKind::flag;
        parsed.options[row.name] = is_flag ? "" : option->results().back();
    }
    return parsed;
}

} // namespace vcarve::cli
