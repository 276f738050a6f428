#pragma once

#include "base/progress.h"
#include "cli/run_log.h"
#include "cli/run_record.h"
#include "io/input/read_model.h"
#include "options/points_arguments.h"

#include <filesystem>
#include <memory>

namespace vcarve::cli {

/// A model that was read, and what a record says of it.
struct ModelInput {
    Scene scene;
    SceneSize read; ///< of what was read
    Json record;    ///< "model", "folder", "format", "cloud", "points", "views", "sights"
};

/// What the command line says of a model: the operand and the options beside it.
struct ModelArguments : PointsArguments {
    std::filesystem::path path;
};

/// Finds and reads the model the user means, as the stage "read". Throws InputError.
ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading = {});

/// What console a command shows its stages on: none where it is to be quiet, all that they count
/// where it is to be verbose.
std::unique_ptr<RunLog> shown_log(bool quiet, bool verbose);

} // namespace vcarve::cli
