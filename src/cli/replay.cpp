#include "cli/replay.h"

#include "base/text.h"
#include "base/version.h"
#include "cli/run_record.h"
#include "io/files/mapped_file.h"
#include "options/declared.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace vcarve::cli {

namespace {

// What the comments begin with.
constexpr std::string_view kProgram = "made by colmap-vcarve ";
constexpr std::string_view kInput = "input ";
constexpr std::string_view kOption = "option ";

/// Those that count for what is written of a scene that was read: which points were taken, its
/// digest says.
OptionList counting_options(MeshArguments& arguments)
{
    OptionList options = joined({options_of(arguments.options), options_of(arguments.output),
                                 texture_options(arguments.texture)});
    std::erase_if(options, [](const Option& option) {
        const std::string& name = option.info.name;
        return option.stage == kRunStage || name == "quiet" || name == "verbose";
    });
    return options;
}

/// As it is told: "max-hole=7", and "crop=FILE" for whatever file.
std::string told(const Option& option)
{
    if (is_flag(option)) return option.info.name;
    const std::string value = value_text(option);
    const bool may_be_path = std::holds_alternative<std::filesystem::path*>(option.value) ||
                             std::holds_alternative<RegionChoice*>(option.value) ||
                             std::holds_alternative<std::string*>(option.value);
    const bool is_path = may_be_path && std::ranges::count(option.info.words, value) == 0 &&
                         value.find_first_not_of("0123456789.,+-e") != std::string::npos;
    return option.info.name + "=" + (is_path ? "FILE" : value);
}

/// What follows the word in each comment that begins with it: in a line of text, or in a string of
/// the JSON of a glTF.
std::vector<std::string> after(std::string_view word, std::string_view bytes)
{
    std::vector<std::string> all;
    for (const std::string_view sign : {"comment ", "# ", "\""}) {
        const std::string begin = std::string(sign) + std::string(word);
        for (std::size_t at = bytes.find(begin); at != bytes.npos; at = bytes.find(begin, at + 1)) {
            const std::string_view rest = bytes.substr(at + begin.size());
            all.push_back(control_free(rest.substr(0, rest.find_first_of("\r\n\""))));
        }
    }
    return all;
}

} // namespace

std::vector<std::string> record_comments(const MeshArguments& arguments, const Digest& scene)
{
    std::vector<std::string> comments = {std::string(kProgram) + versions().program,
                                         std::string(kInput) + digest_text(scene)};
    MeshArguments usual;
    MeshArguments given = arguments;
    const OptionList defaults = counting_options(usual);
    const OptionList options = counting_options(given);
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (value_text(options[i]) == value_text(defaults[i])) continue;
        comments.push_back(std::string(kOption) + told(options[i]));
    }
    return comments;
}

std::string replay_text(const std::filesystem::path& surface)
{
    constexpr std::size_t kMost = 1 << 16; // begins and ends of files hold the comments
    const MappedFile file(surface);
    const std::string_view all(file.bytes().data(), file.bytes().size());
    std::string bytes(all.substr(0, kMost));
    if (all.size() > kMost) bytes += all.substr(std::max(kMost, all.size() - kMost));
    const std::vector<std::string> program = after(kProgram, bytes);
    const std::vector<std::string> input = after(kInput, bytes);
    if (program.empty() || input.empty()) {
        throw InputError(
            fmt::format("{}: found no record of the run that made it", surface.string()));
    }
    std::vector<std::string> words = {"MODEL", surface.string()};
    for (const std::string& option : after(kOption, bytes)) {
        words.push_back("--" + option);
    }
    return fmt::format("{}\n# with version {}, of a MODEL, as --points and the like have it read, "
                       "with the digest {}, which --stats tells\n",
                       command_text("colmap-vcarve", words), program.front(), input.front());
}

} // namespace vcarve::cli
