#pragma once

#include "pipeline/predicted_time.h"

namespace vcarve::cli {

/// What the program does when the surface is made.
struct ExpectedOutputs {
    bool preview = false;
    bool report = false;
    double photo_pixels = 0.0; ///< of all photographs that colours are taken from
    bool texture = false;
};

/// What the program will take, with what it writes.
PredictedTimes expected_run(const SceneSize& read, const Options& options,
                            const ExpectedOutputs& outputs, int threads);

} // namespace vcarve::cli
