#include "cli/manual.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::cli {

namespace {

/// Text that roff sets as it stands: hyphens stay hyphens, and no line begins with a request.
std::string roff(const std::string& text)
{
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\\') {
            escaped += "\\e";
        } else if (letter == '-') {
            escaped += "\\-";
        } else {
            escaped += letter;
        }
    }
    const bool is_request = escaped.starts_with('.') || escaped.starts_with('\'');
    return is_request ? "\\&" + escaped : escaped;
}

std::string tagged(const std::string& tag, const std::string& text)
{
    return fmt::format(".TP\n{}\n{}\n", tag, roff(text));
}

std::string option_entry(const Option& option)
{
    const std::string& name = option.info.name;
    std::string tag = name == "help" ? "\\fB\\-h\\fR, " : name == "verbose" ? "\\fB\\-v\\fR, " : "";
    tag += "\\fB" + roff("--" + name) + "\\fR";
    if (!is_flag(option)) tag += " \\fI" + roff(placeholder(option)) + "\\fR";
    std::string text = option.info.help;
    const std::string initial = default_text(option);
    const std::string range = range_text(option);
    if (!initial.empty()) text += fmt::format(" Default: {}.", initial);
    if (!range.empty()) text += fmt::format(" Range: {}.", range);
    return tagged(tag, text);
}

std::string options_section(const Manual& manual)
{
    std::string text;
    std::string_view stage;
    for (const Option& option : manual.options) {
        if (option.info.tuning) continue;
        if (option.stage != stage) text += fmt::format(".SS {}\n", roff(std::string(option.stage)));
        stage = option.stage;
        text += option_entry(option);
    }
    return text;
}

std::string synopsis(std::span<const Manual> manuals)
{
    std::string text;
    for (const Manual& manual : manuals) {
        text += fmt::format("{}\\fB{}\\fR \\fI{}\\fR [options]\n", text.empty() ? "" : ".br\n",
                            roff(manual.command), roff(manual.operands));
    }
    return text;
}

std::string command_section(const Manual& manual)
{
    std::string text = fmt::format("{}\n", roff(manual.summary));
    for (const auto& [operand, meaning] : manual.operand_meanings) {
        text += tagged("\\fI" + roff(operand) + "\\fR", meaning);
    }
    return text;
}

} // namespace

std::string man_page(std::span<const Manual> manuals, const std::string& version)
{
    const Manual& program = manuals.front();
    std::string title = program.command;
    std::ranges::transform(title, title.begin(),
                           [](unsigned char letter) { return std::toupper(letter); });
    std::string text = fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n", roff(title),
                                   program.command, version);
    text += fmt::format(".SH NAME\n{} \\- surfaces from COLMAP models\n", roff(program.command));
    text += ".SH SYNOPSIS\n" + synopsis(manuals);
    text += ".SH DESCRIPTION\n" + command_section(program);
    text += ".SH OPTIONS\n" + options_section(program);
    for (const Manual& manual : manuals.subspan(1)) {
        text += fmt::format(".SH {}\n", roff(manual.command));
        text += command_section(manual) + options_section(manual);
    }
    text += ".SH EXAMPLES\n";
    for (const Manual& manual : manuals) {
        for (const auto& [example, meaning] : manual.examples) {
            text += tagged("\\fB" + roff(example) + "\\fR", meaning);
        }
    }
    text += ".SH NOTES\n";
    for (const auto& [term, meaning] : program.footnotes) {
        text += tagged("\\fB" + roff(term) + "\\fR", meaning);
    }
    return text;
}

} // namespace vcarve::cli
