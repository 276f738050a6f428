#pragma once

#include "base/progress.h"
#include "io/input/find_input.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "vcarve/io.h"

#include <filesystem>
#include <functional>

namespace vcarve {

/// A model that was read, and where it was found.
struct ReadModel {
    Scene scene;
    SceneSize read; ///< of all points that were read, also those that are not in the scene
    FoundInput found;
};

/// Makes a scene of points whose reprojection errors are not known, which come part by part.
using Gather = std::function<Scene(SceneParts& parts, const Progress& progress)>;

/// What is done with a model before it is read, and while it is.
struct Reading {
    /// Called before, where the size of the model shows then; may throw. Or nothing.
    std::function<void(const SceneSize&)> check = {};
    Gather gather = {}; ///< nothing: all points as they are; of no use to the sparse ones
};

/// As the public one; tells where the model was found, too.
ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const Reading& reading = {});

} // namespace vcarve
