#pragma once

#include "io/input/find_input.h"
#include "vcarve/io.h"

#include <filesystem>
#include <functional>

namespace vcarve {

struct SceneSize;

/// A model that was read, and where it was found.
struct ReadModel {
    Scene scene;
    FoundInput found;
};

/// What is to be checked of a model before it is read; may throw.
using SizeCheck = std::function<void(const SceneSize&)>;

/// As the public one; tells where the model was found, too. `check` is called before reading, where
/// the size of the model shows before.
ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const SizeCheck& check = {});

} // namespace vcarve
