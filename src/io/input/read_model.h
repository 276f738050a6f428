#pragma once

#include "base/progress.h"
#include "io/input/find_input.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "vcarve/io.h"

#include <filesystem>
#include <functional>

namespace vcarve {

/// A model, and the files it was read from.
struct ReadModel {
    Scene scene;
    SceneSize read; ///< size of the input, including points that are not in the scene
    FoundInput found;
};

/// Makes a scene from parts whose points have no reprojection errors.
using Gather = std::function<Scene(SceneParts& parts, const Progress& progress)>;

/// Callbacks of read_found_model().
struct Reading {
    /// Called before reading if the model's size is known by then. It may throw, and may be empty.
    std::function<void(const SceneSize&)> check = {};
    Gather gather = {}; ///< if empty, keeps all points; not called for sparse points
};

/// Reads a model like read_model(). Also returns the files it was read from.
ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const Reading& reading = {});

} // namespace vcarve
