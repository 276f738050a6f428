#pragma once

#include "model/scene_check.h"
#include "vcarve/options.h"

#include <string>
#include <vector>

namespace vcarve {

/// How long a stage of a run is expected to take.
struct StageTime {
    std::string stage; ///< as the log calls it
    double seconds;
};

/// What is expected of a run: its stages in order, and how many points the later ones work on.
struct PredictedTimes {
    std::vector<StageTime> stages;
    double points = 0.0; ///< that are left when the model is read
};

/// What a run that reads so much will take, stage by stage, judging by counts and options alone.
/// The seconds are those of one machine (docs/speed.md); what holds elsewhere is their proportions,
/// as far as models resemble each other: of one model a stage may take five times what it takes of
/// another of that size. RunClock corrects them while a run goes on. `threads` is 1 or more.
PredictedTimes predicted_times(const SceneSize& read, const Options& options, int threads);

} // namespace vcarve
