#pragma once

#include "base/log.h"
#include "cli/option_parser.h"
#include "cli/run_log.h"
#include "cli/run_record.h"
#include "io/input/read_model.h"

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
struct ModelArguments {
    std::filesystem::path path;
    PointsOptions points;
};

/// Declares the options that choose points, under a heading of their own.
void list_points_options(OptionTable& table);
PointsOptions read_points_options(const ParsedArguments& given);

/// Finds and reads the model the user means, as the stage "read". Throws InputError.
ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading = {});

/// What console a command shows its stages on: none where it is to be quiet.
std::unique_ptr<RunLog> shown_log(bool quiet);

} // namespace vcarve::cli
