#pragma once

#include "base/progress.h"
#include "io/input/find_input.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "vcarve/io.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

namespace vcarve {

/// A model, and the files it was read from.
struct ReadModel {
    Scene scene;
    SceneSize read; ///< size of the input, including points that are not in the scene
    FoundInput found;
    std::size_t one_in = 1; ///< the scene has one of this many points of the model
};

/// Makes a scene from parts whose points have no reprojection errors.
using Gather = std::function<Scene(SceneParts& parts, const Progress& progress)>;

/// Callbacks of read_found_model().
struct Reading {
    /// Called before reading if the model's size is known by then. It may throw, and may be empty.
    std::function<void(const SceneSize&)> check = {};
    Gather gather = {}; ///< if empty, keeps all points; not called for sparse points
    /// Whether a sample of sparse points is enough (PointSample), because read_points() reads all
    /// of them in parts. Called with the size if it is known. Not followed if rays are missing,
    /// because completing them needs all points. May be empty.
    std::function<bool(const std::optional<SceneSize>&)> wants_sample = {};
};

/// Reads a model that was found, like read_model().
ReadModel read_found_model(FoundInput found, Log& log, const Reading& reading = {});

/// Reads the points of a model once more, in parts of at most `most`, without cameras and views.
/// Throws InputError and Cancelled.
void read_points(const ReadModel& model, std::size_t most, const TakePoints& take,
                 const Progress& progress = {});

} // namespace vcarve
