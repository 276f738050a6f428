#pragma once

#include "base/progress.h"
#include "pipeline/stage_memory.h"
#include "vcarve/log.h"

#include <span>

namespace vcarve {

struct RunState;

/// The parts of a run.
enum class Part {
    input,
    plan,
    points,
    cells,
    rays,
    surface,
    refinement,
    dense, ///< dense points, measured with the sparse surface
    masks,
    photo_refinement,
    texture,
    output
};

/// The description of a stage of a run.
struct RunStage {
    const char* name; ///< name in the log
    Part part;
    bool (*applies)(const Needs&); ///< whether a run has this stage
    /// Runs the stage and returns counts for the log; null if the pipeline's caller runs it.
    Counts (*run)(RunState&, const Progress&);
    double (*bytes)(const Needs&) = nullptr; ///< size of its arrays; null if small
};

/// The stages of every run, in order. They also predict memory.
std::span<const RunStage> all_stages();

/// Runs the stages of a part, and logs each. Throws the exceptions of the stages.
void run_stages(Part part, RunState& run);

/// The functions of the stages. Each calls a step of the method, and returns counts.
namespace stage_runs {

Counts predict_memory(RunState& run, const Progress& progress);
Counts thin(RunState& run, const Progress& progress);
Counts filter(RunState& run, const Progress& progress);
Counts add_points(RunState& run, const Progress& progress);
Counts crop(RunState& run, const Progress& progress);
Counts denoise(RunState& run, const Progress& progress);
Counts triangulate(RunState& run, const Progress& progress);
Counts walk_rays(RunState& run, const Progress& progress);
Counts cut_first(RunState& run, const Progress& progress); ///< keeps the evidence
Counts carve_first(RunState& run, const Progress& progress);
Counts cut(RunState& run, const Progress& progress);
Counts carve(RunState& run, const Progress& progress);
Counts place_virtual_views(RunState& run, const Progress& progress);
Counts walk_virtual_rays(RunState& run, const Progress& progress);
Counts surface(RunState& run, const Progress& progress);
Counts clean(RunState& run, const Progress& progress);
Counts count_open(RunState& run, const Progress& progress);
Counts denoise_vertices(RunState& run, const Progress& progress);
Counts decimate(RunState& run, const Progress& progress);
Counts guard_rays(RunState& run, const Progress& progress);
Counts smooth(RunState& run, const Progress& progress);
Counts simplify(RunState& run, const Progress& progress);
Counts orient(RunState& run, const Progress& progress);
Counts undistort(RunState& run, const Progress& progress); ///< photo_stages.cpp, as the next ones
Counts match(RunState& run, const Progress& progress);
Counts fuse(RunState& run, const Progress& progress);
Counts remove_masked(RunState& run, const Progress& progress);
Counts refine_by_photos(RunState& run, const Progress& progress);
Counts merge_refined(RunState& run, const Progress& progress);
Counts find_photos(RunState& run, const Progress& progress);
Counts color(RunState& run, const Progress& progress);
Counts paint(RunState& run, const Progress& progress);

} // namespace stage_runs

} // namespace vcarve
