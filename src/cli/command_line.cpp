#include "cli/command_line.h"

#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <sstream>

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

/// The value of the option at words[i]; advances `i` if the value is the next word.
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

const Option& typed_option(std::string_view name, const OptionList& options)
{
    const std::string_view full = name == "-h" ? "--help" : name == "-v" ? "--verbose" : name;
    const Option* option = full.starts_with("--") ? find_option(full.substr(2), options) : nullptr;
    if (option == nullptr) refuse_unknown(name, options);
    if (option->info.level == OptionLevel::library) {
        throw UsageError(fmt::format("{} can be set from C++ and Python only, not on the command "
                                     "line",
                                     name));
    }
    return *option;
}

/// Throws UsageError if a flag has a value, after = or as the next word.
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

constexpr std::size_t kColumns = 80;
constexpr std::size_t kIndent = 30; ///< of the right column

std::string usage_of(const Option& option)
{
    const std::string& name = option.info.name;
    const std::string letter = name == "help" ? "-h, " : name == "verbose" ? "-v, " : "";
    const std::string value = placeholder(option);
    return fmt::format("{}--{}{}{}", letter, name, value.empty() ? "" : " ", value);
}

std::string default_text(const Option& option)
{
    return is_flag(option) ? "" : value_text(option);
}

/// "[default: 12, max: 64]"
std::string default_and_range(const Option& option)
{
    std::string text = default_text(option);
    if (!text.empty()) text = "default: " + text;
    const std::string range = range_text(option);
    if (!range.empty()) text += (text.empty() ? "" : ", ") + range;
    return text.empty() ? "" : "[" + text + "]";
}

/// The first sentence without its full stop.
std::string first_sentence(std::string text)
{
    text.resize(std::min(text.find(". "), text.size()));
    if (text.ends_with('.')) text.pop_back();
    return text;
}

/// A term and its text in two columns. Lines break between words, but not within `mark`.
std::string entry(const std::string& term, const std::string& text, const std::string& mark = "")
{
    const std::string indent(kIndent, ' ');
    std::string block = "  " + term;
    block += block.size() + 2 <= kIndent ? indent.substr(block.size()) : "\n" + indent;
    std::size_t column = kIndent;
    const auto add = [&](const std::string& word) {
        const bool is_first = column == kIndent;
        const bool fits = is_first || column + 1 + word.size() <= kColumns;
        block += is_first ? word : fits ? " " + word : "\n" + indent + word;
        column = (is_first ? kIndent : fits ? column + 1 : kIndent) + word.size();
    };
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        add(word);
    }
    if (!mark.empty()) add(mark);
    return block + "\n";
}

/// Escapes the end of a Markdown table's cell.
std::string cell(const std::string& text)
{
    std::string escaped;
    for (const char letter : text) {
        if (letter == '|') escaped.push_back('\\');
        escaped.push_back(letter);
    }
    return escaped;
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
        if (words[i].empty()) throw UsageError(fmt::format("argument {} is empty", i + 1));
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
            given.options["points"] = value_of(typed_option("--points", options), word, words, i);
        } else {
            const Option& option = typed_option(word.name, options);
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

OptionList options_of(HelpOptions& help)
{
    constexpr const char* kStage = "Help";
    return {
        {kStage, {.name = "help", .help = "Print this help."}, &help.help},
        {kStage, {.name = "help-all", .help = "Print all options."}, &help.help_all},
        {kStage,
         {.name = "version", .help = "Print versions of the program and its libraries."},
         &help.version},
    };
}

std::string help_text(const Manual& manual, bool all)
{
    std::string text = fmt::format("{}\n\nUsage: {} {} [options]\n\nExamples:\n", manual.summary,
                                   manual.command, manual.operands);
    std::size_t widest = 0;
    for (const auto& [example, meaning] : manual.examples) {
        widest = std::max(widest, example.size());
    }
    for (const auto& [example, meaning] : manual.examples) {
        text += fmt::format("  {:<{}}  {}\n", example, widest, meaning);
    }
    text += "\nArguments:\n";
    for (const auto& [operand, meaning] : manual.operand_meanings) {
        text += entry(operand, all ? meaning : first_sentence(meaning));
    }
    std::string_view stage;
    for (const Option& option : manual.options) {
        const OptionInfo& info = option.info;
        if (info.level > (all ? OptionLevel::advanced : OptionLevel::common)) continue;
        if (option.stage != stage) text += fmt::format("\n{} options:\n", option.stage);
        stage = option.stage;
        text += entry(usage_of(option), all ? info.help : first_sentence(info.help),
                      default_and_range(option));
    }
    text += "\n";
    for (const std::string& line : manual.ends) {
        text += line + "\n";
    }
    return text;
}

std::string markdown_options(const Manual& manual)
{
    std::string text = fmt::format("## {} {}\n", manual.command, manual.operands);
    std::string tables[2]; // command line; C++ and Python only
    std::string_view stages[2];
    for (const Option& option : manual.options) {
        const bool library = option.info.level == OptionLevel::library;
        if (option.stage != stages[library]) {
            tables[library] += fmt::format("\n{} {} options\n\n| option | default | range | "
                                           "meaning |\n|---|---|---|---|\n",
                                           library ? "####" : "###", option.stage);
        }
        stages[library] = option.stage;
        tables[library] += fmt::format(
            "| `{}` | {} | {} | {} |\n", library ? option.info.name : cell(usage_of(option)),
            default_text(option), range_text(option), cell(option.info.help));
    }
    text += tables[0];
    if (!tables[1].empty()) {
        text += "\n### C++ and Python only\n\nThese options are for studying the method. In Python "
                "they are keywords, with `_` for `-`.\n" +
                tables[1];
    }
    return text;
}

} // namespace vcarve::cli
