#include "cli/option_parser.h"

#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace vcarve::cli {

namespace {

/// Levenshtein's distance: the number of letters inserted, removed or replaced.
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

/// A word of the command line that begins with a dash.
struct DashedWord {
    std::string name; ///< with its dashes
    std::optional<std::string> value;
};

DashedWord split(const std::string& word)
{
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return {word, std::nullopt};
    return {word.substr(0, equals), word.substr(equals + 1)};
}

/// The value of the option at words[i]; advances `i` if it is the next word.
std::string take_value(const DashedWord& word, std::span<const std::string> words, std::size_t& i)
{
    if (word.value) return *word.value;
    const bool is_next = i + 1 < words.size() && !words[i + 1].starts_with("--");
    return is_next ? words[++i] : "";
}

[[noreturn]] void refuse_unknown(std::string_view name, const OptionList& options)
{
    std::vector<std::string> names;
    for (const Option& option : options) {
        if (option.info.level != OptionLevel::library) names.push_back("--" + option.info.name);
    }
    const std::string near = nearest(name, names);
    const std::string hint = near.empty() ? "" : fmt::format("; did you mean {}?", near);
    throw UsageError(fmt::format("there is no option {}{}{}", name, hint, kSeeHelp));
}

const Option& find_option(std::string_view name, const OptionList& options)
{
    const std::string_view full = name == "-h" ? "--help" : name == "-v" ? "--verbose" : name;
    const auto is_it = [&](const Option& option) { return "--" + option.info.name == full; };
    const auto option = std::ranges::find_if(options, is_it);
    if (option == options.end()) refuse_unknown(name, options);
    if (option->info.level == OptionLevel::library) {
        throw UsageError(fmt::format("{} can be set from C++ and Python only, not on the command "
                                     "line",
                                     name));
    }
    return *option;
}

/// Throws UsageError for a value given to a flag, also as the next word.
void refuse_value(const Option& option, const DashedWord& word, std::string_view next)
{
    constexpr std::array kValues = {"yes", "no", "true", "false", "on", "off"};
    const bool is_next = std::ranges::count(kValues, next) != 0;
    if (!word.value && !is_next) return;
    throw UsageError(fmt::format("--{} takes no value; remove \"{}\"", option.info.name,
                                 word.value ? *word.value : next));
}

/// The value of an option; empty for a flag.
std::string value_of(const Option& option, const DashedWord& word,
                     std::span<const std::string> words, std::size_t& i)
{
    if (is_flag(option)) {
        refuse_value(option, word, i + 1 < words.size() ? words[i + 1] : "");
        return "";
    }
    std::string value = take_value(word, words, i);
    if (!value.empty()) return value;
    throw UsageError(fmt::format("--{} needs a value: {}", option.info.name, accepted(option)));
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

ParsedArguments parse_arguments(std::span<const std::string> words, const OptionList& options)
{
    ParsedArguments given;
    given.typed.assign(words.begin(), words.end());
    bool after_dashes = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (after_dashes || words[i].size() < 2 || words[i].front() != '-') {
            given.operands.push_back(words[i]);
            continue;
        }
        after_dashes = words[i] == "--";
        if (after_dashes) continue;
        const DashedWord word = split(words[i]);
        if (word.name == "-i" || word.name == "--input_path") {
            given.operands.insert(given.operands.begin(), take_value(word, words, i));
        } else if (word.name == "-o" || word.name == "--output_path") {
            given.named_output = take_value(word, words, i);
        } else if (word.name == "--input_type") {
            given.options["points"] = value_of(find_option("--points", options), word, words, i);
        } else {
            const Option& option = find_option(word.name, options);
            given.options[option.info.name] = value_of(option, word, words, i);
        }
    }
    if (!given.named_output.empty()) given.operands.push_back(given.named_output);
    return given;
}

void read_options(const ParsedArguments& given, const OptionList& options)
{
    for (const Option& option : options) {
        const auto value = given.options.find(option.info.name);
        if (value != given.options.end()) set_value(option, value->second);
    }
}

} // namespace vcarve::cli
