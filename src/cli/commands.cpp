#include "cli/commands.h"

#include "base/version.h"
#include "cli/compare_command.h"
#include "cli/mesh_arguments.h"
#include "cli/mesh_command.h"
#include "io/files/output_file.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace vcarve::cli {

namespace {

/// Whether words are options only, so that what follows them may be a command.
bool are_options(std::span<const std::string> words, const OptionList& options)
{
    try {
        return parse_arguments(words, options).operands.empty();
    } catch (const UsageError&) {
        return false;
    }
}

/// The command that the first operand names, whose name is taken out of the words.
const Command& command_in(std::vector<std::string>& words, std::span<const Command> commands)
{
    for (const Command& command : commands) {
        const auto named = std::ranges::find(words, command.name);
        if (command.name.empty() || named == words.end()) continue;
        if (!are_options({words.begin(), named}, command.manual().options)) continue;
        words.erase(named);
        return command;
    }
    return commands.front();
}

std::string version_text()
{
    const Versions build = versions();
    return fmt::format("colmap-vcarve {}\n"
                       "{} build, {}\n"
                       "CGAL {}, OpenMesh {}, Eigen {}, oneTBB {}\n"
                       "Licence: GPL-3.0-or-later\n",
                       program_version(), build.build_type, build.compiler, build.cgal,
                       build.openmesh, build.eigen, build.tbb);
}

/// "help", "help compare" and "version" say what options would.
std::vector<std::string> words_meant(std::span<const std::string> arguments)
{
    std::vector<std::string> words(arguments.begin(), arguments.end());
    if (words == std::vector<std::string>{"version"}) return {"--version"};
    if (words.empty() || words.size() > 2 || words[0] != "help") return words;
    words.erase(words.begin());
    words.emplace_back("--help");
    return words;
}

/// What the build and the documents are made with: the same declarations in other forms.
std::string generated_text(std::string_view form, const Manual& manual,
                           std::span<const Command> commands)
{
    std::vector<Manual> manuals;
    for (const Command& command : commands) {
        manuals.push_back(command.manual());
    }
    if (form == "--help-man") return man_page(manuals, versions().program);
    if (form == "--help-bash") return bash_completion(manuals);
    if (form == "--help-markdown") return markdown_options(manual);
    return "";
}

} // namespace

std::vector<Command> commands()
{
    return {{"", mesh_manual, [](const ParsedArguments& given) { run_mesh(given); }},
            {"compare", compare_manual, run_compare}};
}

void run_command_line(std::span<const std::string> arguments, std::span<const Command> commands)
{
    std::vector<std::string> meant = words_meant(arguments);
    const Command& command = command_in(meant, commands);
    arguments = meant;

    const Manual manual = command.manual();
    if (arguments.size() == 1) {
        const std::string text = generated_text(arguments[0], manual, commands);
        if (!text.empty()) return print(text);
    }
    const ParsedArguments given = parse_arguments(arguments, manual.options);
    if (given.has("help") || given.has("help-all")) {
        return print(help_text(manual, given.has("help-all")));
    }
    if (given.has("version")) return print(version_text());
    command.run(given);
}

} // namespace vcarve::cli
