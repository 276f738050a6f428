#include "cli/commands.h"

#include "base/version.h"
#include "cli/compare_command.h"
#include "cli/manual.h"
#include "cli/mesh_command.h"
#include "cli/option_parser.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

namespace vcarve {

namespace {

struct Command {
    const char* name; ///< first word of the command line; empty for the bare form
    cli::Manual (*manual)();
    void (*run)(const cli::ParsedArguments&);
};

/// All commands, the bare form first.
constexpr Command kCommands[] = {
    {"", cli::mesh_manual, cli::run_mesh},
    {"compare", cli::compare_manual, cli::run_compare},
};

void print(const std::string& text)
{
    std::fputs(text.c_str(), stdout);
    if (std::fflush(stdout) != 0) throw UsageError("cannot write to the standard output");
}

const Command& command_named(std::string_view name)
{
    for (const Command& command : kCommands) {
        if (command.name == name) return command;
    }
    return kCommands[0];
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

/// What the build and the README are made with: the same declarations in other forms.
std::string generated_text(std::string_view form, const cli::Manual& manual)
{
    std::vector<cli::Manual> manuals;
    for (const Command& command : kCommands) {
        manuals.push_back(command.manual());
    }
    if (form == "--help-man") return cli::man_page(manuals, versions().program);
    if (form == "--help-bash") return cli::bash_completion(manuals);
    if (form == "--help-markdown") return cli::markdown_options(manual);
    return "";
}

} // namespace

void run_command_line(std::span<const std::string> arguments)
{
    const Command& command = command_named(arguments.empty() ? "" : arguments[0]);
    if (command.name[0] != '\0') arguments = arguments.subspan(1);

    const cli::Manual manual = command.manual();
    if (arguments.size() == 1) {
        const std::string text = generated_text(arguments[0], manual);
        if (!text.empty()) return print(text);
    }
    const cli::ParsedArguments given = cli::parse_arguments(arguments, manual.options);
    if (given.has("help")) return print(cli::help_text(manual));
    if (given.has("version")) return print(version_text());
    command.run(given);
}

} // namespace vcarve
