#include "cli/input_output.h"

#include "cli/exit_code.h"
#include "io/colmap/model_files.h"
#include "io/files/output_file.h"
#include "io/input/find_input.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// Whether two paths name the same file. Missing files are compared by path.
bool is_same_file(const fs::path& a, const fs::path& b)
{
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const fs::path real = fs::weakly_canonical(a, error);
    return !error && real == fs::weakly_canonical(b, error);
}

[[noreturn]] void refuse(const Output& output, const Output& replaced)
{
    throw UsageError(
        fmt::format("{} would replace {} {}", output.name, replaced.name, replaced.path.string()));
}

void refuse_replacing(const Output& output, std::span<const Output> files)
{
    for (const Output& file : files) {
        std::error_code error;
        if (output.path == file.path || fs::equivalent(output.path, file.path, error)) {
            refuse(output, file);
        }
    }
}

} // namespace

void require_distinct(std::span<const Output> outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (!is_same_file(outputs[i].path, outputs[k].path)) continue;
            throw UsageError(fmt::format("{} and {} cannot both be written to {}", outputs[i].name,
                                         outputs[k].name, outputs[i].path.string()));
        }
    }
}

OptionList options_of(ConsoleArguments& arguments, const char* quiet_help)
{
    return {
        {kRunStage, {.name = "quiet", .help = quiet_help}, &arguments.quiet},
        {kRunStage,
         {.name = "verbose",
          .help = "Print every stage with all its counts.",
          .level = OptionLevel::advanced},
         &arguments.verbose},
        {kRunStage,
         {.name = "threads",
          .unit = "threads",
          .help = "Use N threads. 0 uses all. Results are the same for any thread count.",
          .max = 1024},
         &arguments.threads},
    };
}

void prepare_outputs(std::span<const Output> outputs, const fs::path& scratch)
{
    std::vector<fs::path> unfinished;
    for (const Output& output : outputs) {
        unfinished.push_back(part_path(output.path));
    }
    if (!scratch.empty()) unfinished.push_back(scratch);
    end_cleanly_on_signals(unfinished);
    for (const Output& output : outputs) {
        require_writable(output.path);
    }
}

void keep_inputs(std::span<const Output> outputs, const RunInput& input,
                 const std::vector<Output>& others)
{
    if (std::ranges::none_of(outputs, is_file, &Output::path)) return;
    std::vector<Output> inputs = others;
    for (const fs::path& file : input_files(input.path, input.found)) {
        inputs.push_back({"the input", file});
    }
    const auto add = [&](const std::optional<Photographs>& images, const char* name) {
        if (!images) return;
        for (const fs::path& file : images->of_view) {
            if (!file.empty()) inputs.push_back({name, file});
        }
    };
    add(input.images.photographs, "the photograph");
    add(input.images.masks, "the mask");
    for (const Output& output : outputs) {
        if (!is_file(output.path)) continue;
        refuse_replacing(output, inputs);
        if (is_image_of_views(output.path, input.found)) refuse(output, {"the image", output.path});
    }
}

fs::path folder_beside(const fs::path& out)
{
    std::error_code error;
    const bool is_device = fs::is_character_file(out, error);
    fs::path folder = is_device ? fs::temp_directory_path(error) / "colmap-vcarve" : out;
    folder += fmt::format(".tiles-{}", ::getpid());
    return folder;
}

Json input_json(const RunInput& input, const ReadModel& model)
{
    const auto& [found, dense, scan, notes, rays] = input.found;
    constexpr std::array kFormats = {"binary", "text", "transforms"};
    Json json = {{"model", input.path.string()},
                 {"folder", found.folder.string()},
                 {"format", kFormats.at(static_cast<std::size_t>(found.format))},
                 {"cloud", nullptr},
                 {"points", model.read.points},
                 {"views", model.read.views},
                 {"rays", model.read.rays}};
    if (scan) json["cloud"] = scan->cloud.string();
    if (scan && found.folder.empty()) {
        json["folder"] = nullptr;
        json["format"] = nullptr;
    }
    if (dense) json["cloud"] = dense->cloud.string();
    return json;
}

} // namespace vcarve::cli
