#include "cli/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace vcarve::cli {

namespace {

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
    std::string tables[2]; // of the command line, of C++ and Python only
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
