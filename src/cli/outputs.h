#pragma once

#include "cli/model_input.h"

#include <filesystem>
#include <span>

namespace vcarve::cli {

/// A file that a command writes or reads, and what it is called in messages.
struct Output {
    const char* name;
    std::filesystem::path path;
};

/// Throws UsageError where two outputs would be one file.
void require_distinct(std::span<const Output> outputs);

/// Throws UsageError where an output would replace a file of the input, whatever path or link leads
/// to it: those that input_files() lists, an image of the views, or one of `others`. Cost: none
/// where no output is there yet; InputError as find_input throws it.
void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others);

} // namespace vcarve::cli
