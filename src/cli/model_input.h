#pragma once

#include "base/log.h"
#include "cli/run_record.h"
#include "io/colmap/read_model.h"

#include <filesystem>
#include <memory>

namespace vcarve::cli {

/// A model that was read, and what a record says of it.
struct ModelInput {
    Scene scene;
    Json record; ///< "model", "folder", "format", "points", "views", "sights"
};

/// Finds and reads the model the user means, as the stage "read". Throws InputError. `check` is
/// called before reading, where the size of the model shows before.
ModelInput read_model_input(const std::filesystem::path& model, Log& log,
                            const SizeCheck& check = {});

/// What console a command shows its stages on: none where it is to be quiet.
std::unique_ptr<Log> shown_log(bool quiet);

} // namespace vcarve::cli
