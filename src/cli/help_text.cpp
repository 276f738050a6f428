#include "cli/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace vcarve::cli {

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 30; ///< where the right column begins

std::string usage_of(const OptionRow& row)
{
    const std::string name = row.name == "help" ? "-h, --help" : "--" + row.name;
    const std::string value = placeholder(row);
    return value.empty() ? name : name + " " + value;
}

/// "[default 12, 0 to 64]"
std::string default_and_range(const OptionRow& row)
{
    if (row.initial.empty()) return "";
    if (row.range.empty()) return fmt::format("[default {}]", row.initial);
    return fmt::format("[default {}, {}]", row.initial, row.range);
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

/// A flag has no value to start from, but it is on or off.
std::string default_cell(const OptionRow& row)
{
    if (row.kind != OptionKind::flag) return row.initial;
    return row.name.starts_with("no-") ? "on" : "off";
}

} // namespace

std::string help_text(const Manual& manual)
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
    std::string stage;
    for (const OptionRow& row : manual.options) {
        if (row.stage != stage) text += fmt::format("\n{}:\n", row.stage);
        stage = row.stage;
        text += entry(usage_of(row), row.help, default_and_range(row));
    }
    text += "\n";
    for (const auto& [term, meaning] : manual.footnotes) {
        text += entry(term, meaning);
    }
    return text;
}

std::string markdown_options(const Manual& manual)
{
    std::string text;
    std::string stage;
    for (const OptionRow& row : manual.options) {
        if (row.stage != stage) {
            text += fmt::format("{}**{}**\n\n| option | default | range | meaning |\n"
                                "|---|---|---|---|\n",
                                stage.empty() ? "" : "\n", row.stage);
        }
        stage = row.stage;
        text += fmt::format("| `{}` | {} | {} | {} |\n", cell(usage_of(row)), default_cell(row),
                            row.range, cell(row.help));
    }
    return text;
}

} // namespace vcarve::cli
