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

/// What the stages do with a run: each calls a step of the method, and counts.
namespace stage_runs {

Counts foresee_memory(RunState& run, const Progress& progress);
Counts thin(RunState& run, const Progress& progress);
Counts filter(RunState& run, const Progress& progress);
Counts add_points(RunState& run, const Progress& progress);
Counts crop(RunState& run, const Progress& progress);
Counts denoise(RunState& run, const Progress& progress);
Counts triangulate(RunState& run, const Progress& progress);
Counts walk_sights(RunState& run, const Progress& progress);
Counts cut_first(RunState& run, const Progress& progress); ///< the evidence stays
Counts carve_first(RunState& run, const Progress& progress);
Counts cut(RunState& run, const Progress& progress);
Counts carve(RunState& run, const Progress& progress);
Counts place_virtual_views(RunState& run, const Progress& progress);
Counts walk_virtual_sights(RunState& run, const Progress& progress);
Counts surface(RunState& run, const Progress& progress);
Counts clean(RunState& run, const Progress& progress);
Counts count_open(RunState& run, const Progress& progress);
Counts settle(RunState& run, const Progress& progress);
Counts decimate(RunState& run, const Progress& progress);
Counts guard_sights(RunState& run, const Progress& progress);
Counts smooth(RunState& run, const Progress& progress);
Counts simplify(RunState& run, const Progress& progress);
Counts orient(RunState& run, const Progress& progress);

} // namespace stage_runs

} // namespace vcarve
