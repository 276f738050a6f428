#pragma once

#include "base/progress.h"
#include "pipeline/stage_memory.h"
#include "vcarve/log.h"

#include <span>

namespace vcarve {

struct RunState;

/// What a run is cut into. What the four in the middle make may be kept (reconstruct.cpp).
enum class Part { input, plan, points, cells, sights, surface, refinement, output };

/// A stage of a run, all that is to be known of it.
struct RunStage {
    const char* name; ///< as the log calls it
    Part part;
    bool (*applies)(const Needs&); ///< whether a run has it
    /// Does it and counts what the log is told; null where who calls the pipeline does.
    Counts (*run)(RunState&, const Progress&);
    double (*bytes)(const Needs&) = nullptr; ///< size of its arrays; null if small
};

/// The stages of every run, in order. They also determine what is resumed and predict memory.
std::span<const RunStage> all_stages();

} // namespace vcarve
