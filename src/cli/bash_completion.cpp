#include "cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vcarve::cli {

namespace {

/// The word after the program's name: "" for the bare form.
std::string subcommand(const Manual& manual)
{
    const std::size_t space = manual.command.find(' ');
    return space == std::string::npos ? "" : manual.command.substr(space + 1);
}

std::string option_names(const Manual& manual)
{
    std::vector<std::string> names;
    for (const Option& option : manual.options) {
        if (!option.info.tuning) names.push_back("--" + option.info.name);
    }
    return fmt::format("{}", fmt::join(names, " "));
}

/// The cases of bash's `case` for the values of one command's options.
std::string value_cases(const Manual& manual)
{
    std::string cases;
    for (const Option& option : manual.options) {
        const bool takes_file = std::holds_alternative<RegionChoice*>(option.value);
        const bool is_path = std::holds_alternative<std::filesystem::path*>(option.value);
        if (is_flag(option) || is_path) continue;
        cases += fmt::format(
            "        --{}) COMPREPLY=($(compgen {}-W \"{}\" -- \"$current\")); return ;;\n",
            option.info.name, takes_file ? "-f " : "", fmt::join(option.info.words, " "));
    }
    return cases;
}

std::string case_of(const Manual& manual, const std::string& pattern)
{
    return fmt::format("    {})\n"
                       "        options=\"{}\"\n"
                       "        case \"$previous\" in\n{}"
                       "        esac ;;\n",
                       pattern, option_names(manual), value_cases(manual));
}

} // namespace

std::string bash_completion(std::span<const Manual> manuals)
{
    const std::string program = manuals.front().command;
    std::vector<std::string> subcommands;
    std::string cases;
    for (const Manual& manual : manuals.subspan(1)) {
        subcommands.push_back(subcommand(manual));
        cases += case_of(manual, subcommands.back());
    }
    cases += case_of(manuals.front(), "*");
    return fmt::format(
        "# bash completion of {0}, made from the options it declares\n"
        "_colmap_vcarve()\n"
        "{{\n"
        "    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}\n"
        "    local options\n"
        "    COMPREPLY=()\n"
        "    case \"${{COMP_WORDS[1]}}\" in\n"
        "{1}"
        "    esac\n"
        "    if [[ $current == -* ]]; then\n"
        "        COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
        "    elif (( COMP_CWORD == 1 )); then\n"
        "        COMPREPLY=($(compgen -W \"{2}\" -- \"$current\"))\n"
        "    fi\n"
        "}}\n"
        "complete -o bashdefault -o default -F _colmap_vcarve {0}\n",
        program, cases, fmt::join(subcommands, " "));
}

} // namespace vcarve::cli
