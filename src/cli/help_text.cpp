#include "cli/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace vcarve::cli {

namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kIndent = 30; ///< where the right column begins

std::string usage_of(const Option& option)
{
    const std::string& name = option.info.name;
    const std::string letter = name == "help" ? "-h, " : name == "verbose" ? "-v, " : "";
    const std::string value = placeholder(option);
    return fmt::format("{}--{}{}{}", letter, name, value.empty() ? "" : " ", value);
}

/// "[default 12, 0 to 64]"
std::string default_and_range(const Option& option)
{
    const std::string initial = default_text(option);
    if (initial.empty()) return "";
    const std::string range = range_text(option);
    if (range.empty()) return fmt::format("[default {}]", initial);
    return fmt::format("[default {}, {}]", initial, range);
}

/// Sets a text into the right column, breaking it between words; `mark` is never broken.
std::string right_column(const std::string& text, const std::string& mark)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    if (!mark.empty()) words.push_back(mark);

    std::string block;
    std::size_t column = kIndent;
    for (const std::string& word : words) {
        if (column > kIndent && column + 1 + word.size() > kColumns) {
            block += "\n" + std::string(kIndent, ' ');
            column = kIndent;
        } else if (column > kIndent) {
            block += ' ';
            ++column;
        }
        block += word;
        column += word.size();
    }
    return block;
}

std::string entry(const std::string& term, const std::string& text, const std::string& mark = "")
{
    const std::string left = "  " + term;
    const bool fits = left.size() + 2 <= kIndent;
    return fmt::format("{:<{}}{}\n", fits ? left : left + "\n" + std::string(kIndent, ' '),
                       fits ? kIndent : 0, right_column(text, mark));
}

/// Escapes what Markdown would take for the end of a table's cell.
std::string cell(const std::string& text)
{
    std::string escaped;
    for (const char letter : text) {
        if (letter == '|') escaped.push_back('\\');
        escaped.push_back(letter);
    }
    return escaped;
}

std::string row_of(const Option& option)
{
    return fmt::format("| `{}` | {} | {} | {} |\n", cell(usage_of(option)), default_text(option),
                       range_text(option), cell(option.info.help));
}

/// A table a stage, of those options that are for tuning or of the others.
std::string tables(const Manual& manual, const std::string& heading, bool tuning)
{
    std::string text;
    std::string_view stage;
    for (const Option& option : manual.options) {
        if (option.info.tuning != tuning) continue;
        if (option.stage != stage) {
            text += fmt::format("\n{} {}\n\n| option | default | range | meaning |\n"
                                "|---|---|---|---|\n",
                                heading, option.stage);
        }
        stage = option.stage;
        text += row_of(option);
    }
    return text;
}

} // namespace

OptionList options_of(HelpOptions& help)
{
    constexpr const char* kStage = "Help";
    return {
        {kStage,
         {.name = "help",
          .help = "Print this and exit; --help-all lists the options for tuning as well."},
         &help.help},
        {kStage,
         {.name = "help-all", .help = "Print this and exit.", .tuning = true},
         &help.help_all},
        {kStage,
         {.name = "version", .help = "Print versions of the program and its libraries."},
         &help.version},
    };
}

std::string default_text(const Option& option)
{
    return is_flag(option) ? "" : value_text(option);
}

std::string help_text(const Manual& manual, bool with_tuning)
{
    std::string text = manual.summary + "\n\n";
    text += fmt::format("Usage: {} {} [options]\n\nExamples:\n", manual.command, manual.operands);
    std::size_t widest = 0;
    for (const auto& [example, meaning] : manual.examples) {
        widest = std::max(widest, example.size());
    }
    for (const auto& [example, meaning] : manual.examples) {
        text += fmt::format("  {:<{}}  {}\n", example, widest, meaning);
    }
    text += "\n";
    for (const auto& [operand, meaning] : manual.operand_meanings) {
        text += entry(operand, meaning);
    }
    std::string_view stage;
    for (const Option& option : manual.options) {
        if (option.info.tuning && !with_tuning) continue;
        if (option.stage != stage) text += fmt::format("\n{}:\n", option.stage);
        stage = option.stage;
        text += entry(usage_of(option), option.info.help, default_and_range(option));
    }
    text += "\n";
    for (const auto& [term, meaning] : manual.footnotes) {
        text += entry(term, meaning);
    }
    return text;
}

std::string markdown_options(const Manual& manual)
{
    std::string text = fmt::format("## {} {}\n", manual.command, manual.operands);
    text += tables(manual, "###", false);
    const std::string tuning = tables(manual, "####", true);
    if (!tuning.empty()) text += "\n### For tuning, listed by `--help-all`\n" + tuning;
    return text;
}

} // namespace vcarve::cli
