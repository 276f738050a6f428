#include "cli/input_output.h"

#include "io/files/path_kind.h"
#include "io/input/input_files.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// Files that do not exist yet are compared by path.
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

void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others)
{
    for (const Output& output : outputs) {
        refuse_replacing(output, others);
    }
    if (std::ranges::none_of(outputs, is_file, &Output::path)) return;
    const FoundInput found = find_input(model.path, model.all_points());
    std::vector<Output> inputs;
    for (const fs::path& file : input_files(model.path, found)) {
        inputs.push_back({"the input", file});
    }
    for (const Output& output : outputs) {
        if (!is_file(output.path)) continue;
        refuse_replacing(output, inputs);
        if (is_image_of_views(output.path, found)) refuse(output, {"the image", output.path});
    }
}

ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading)
{
    ReadModel read = read_found_model(model.path, model.all_points(), log, reading);
    const FoundModel& found = read.found.model;
    constexpr std::array kFormats = {"binary", "text", "transforms"};
    ModelInput input;
    input.record = {{"model", model.path.string()},
                    {"folder", found.folder.string()},
                    {"format", kFormats.at(static_cast<std::size_t>(found.format))},
                    {"cloud", nullptr},
                    {"points", read.read.points},
                    {"views", read.read.views},
                    {"sights", read.read.sights}};
    if (read.found.scan) input.record["cloud"] = read.found.scan->cloud.string();
    if (read.found.scan && found.folder.empty()) {
        input.record["folder"] = nullptr;
        input.record["format"] = nullptr;
    }
    if (read.found.dense) input.record["cloud"] = read.found.dense->cloud.string();
    input.scene = std::move(read.scene);
    input.read = read.read;
    return input;
}

} // namespace vcarve::cli
