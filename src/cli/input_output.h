#pragma once

#include "base/log.h"
#include "cli/run_record.h"
#include "io/input/read_model.h"
#include "options/declared.h"

#include <filesystem>
#include <span>

namespace vcarve::cli {

/// The operand MODEL and the options that choose its points.
struct ModelArguments : PointsArguments {
    std::filesystem::path path;
};

/// A file that a command writes or reads, and its name in messages.
struct Output {
    const char* name;
    std::filesystem::path path;
};

/// Throws UsageError if two outputs would be one file.
void require_distinct(std::span<const Output> outputs);

/// Throws UsageError if an output would replace a file of the input, by any path or link: one of
/// input_files(), an image of the views, or one of `others`. Throws InputError as find_input()
/// does. Costs nothing if no output exists yet.
void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others);

/// A model and its record.
struct ModelInput {
    Scene scene;
    SceneSize read; ///< before points were merged
    Json record;    ///< "model", "folder", "format", "cloud", "points", "views", "sights"
};

/// Finds and reads a model, as the stage "read". Throws InputError.
ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading = {});

} // namespace vcarve::cli
