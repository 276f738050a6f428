#pragma once

#include "base/progress.h"
#include "pipeline/run_state.h"
#include "vcarve/log.h"

/// What the stages of stages.h do with a run: each calls a step of the method, and counts.
namespace vcarve::stage_runs {

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
Counts make_surface(RunState& run, const Progress& progress);
Counts clean(RunState& run, const Progress& progress);
Counts count_open(RunState& run, const Progress& progress);
Counts settle(RunState& run, const Progress& progress);
Counts guard_sights(RunState& run, const Progress& progress);
Counts smooth(RunState& run, const Progress& progress);
Counts simplify(RunState& run, const Progress& progress);
Counts orient(RunState& run, const Progress& progress);

} // namespace vcarve::stage_runs
