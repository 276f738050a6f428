#include "cli/commands.h"

#include "base/version.h"
#include "cli/mesh_arguments.h"
#include "io/files/output_file.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::cli {

namespace {

/// Whether the words are options only, so that a command may follow.
bool are_options(std::span<const std::string> words, const OptionList& options)
{
    try {
        return parse_arguments(words, options).operands.empty();
    } catch (const UsageError&) {
        return false;
    }
}

/// The command that the first operand names; its name is removed from the words.
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
                       "License: GPL-3.0-or-later\n",
                       program_version(), build.build_type, build.compiler, build.cgal,
                       build.openmesh, build.eigen, build.tbb);
}

/// Replaces "help", "help compare" and "version" by options.
std::vector<std::string> words_meant(std::span<const std::string> arguments)
{
    std::vector<std::string> words(arguments.begin(), arguments.end());
    if (words == std::vector<std::string>{"version"}) return {"--version"};
    if (words.empty() || words.size() > 2 || words[0] != "help") return words;
    words.erase(words.begin());
    words.emplace_back("--help");
    return words;
}

} // namespace

std::vector<Command> commands()
{
    return {{"", mesh_manual, run_mesh},
            {"compare", compare_manual, run_compare},
            {"texture", texture_manual, run_texture},
            {"refine", refine_manual, run_refine}};
}

void run_command_line(std::span<const std::string> arguments, std::span<const Command> commands)
{
    std::vector<std::string> meant = words_meant(arguments);
    const Command& command = command_in(meant, commands);
    arguments = meant;

    const Manual manual = command.manual();
    if (arguments.size() == 1 && arguments[0] == "--help-markdown") { // for docs/options.md
        return print(markdown_options(manual));
    }
    const ParsedArguments given = parse_arguments(arguments, manual.options);
    if (given.has("help") || given.has("help-all")) {
        return print(help_text(manual, given.has("help-all")));
    }
    if (given.has("version")) return print(version_text());
    command.run(given);
}

} // namespace vcarve::cli
