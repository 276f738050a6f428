#include "cli/outputs.h"

#include "io/colmap/model_files.h"
#include "io/input/find_input.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

namespace vcarve::cli {

namespace fs = std::filesystem;

namespace {

/// Also of files that are not there yet.
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

} // namespace vcarve::cli
