#include "vcarve/reconstruct.h"

#include "base/free_memory.h"
#include "model/scene_check.h"
#include "options/declared.h"
#include "pipeline/memory.h"
#include "pipeline/run_state.h"
#include "pipeline/stages.h"
#include "pipeline/thinned_scene.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/thin.h"

#include <tbb/task_arena.h>

#include <utility>

namespace vcarve {

namespace {

/// Makes the points and the region.
void make_points(RunState& run)
{
    run.points.scene = center_points(std::move(run.points.scene));
    return_freed_memory();
    run_stages(Part::plan, run);
    run.checkpoints.keep("points", run.points, [&] { run_stages(Part::points, run); });
    if (!run.region) { // the points came from a checkpoint
        run.region =
            make_region(run.options().crop.region, run.points.scene.offset, run.points.of_interest);
    }
    return_freed_memory();
}

/// Carves the visible faces, and frees the cells.
void carve(RunState& run)
{
    run.checkpoints.keep("cells", run.cells, [&] { run_stages(Part::cells, run); });
    run.checkpoints.keep("rays", run.evidence, [&] { run_stages(Part::rays, run); });
    run_stages(Part::surface, run);
    run.cells = {};
    run.virtual_rays = {};
}

/// Runs all stages after thinning.
Reconstruction run_parts(RunState run, RemovedFaces* removed)
{
    make_points(run);
    run.checkpoints.keep(run.wants_removed ? "surface-and-removed" : "surface", run.carved,
                         [&] { carve(run); });
    return_freed_memory();
    run_stages(Part::refinement, run);
    if (removed != nullptr) *removed = std::move(run.carved.removed);
    return {std::move(run.points.scene), std::move(run.surface)};
}

Reconstruction thin_and_run(Scene scene, const Options& options, Log& log)
{
    Checkpoints nowhere(nullptr, log);
    RunState run = {.size = size_before_thinning(size_of(scene), options),
                    .checkpoints = nowhere,
                    .points = {std::move(scene), {}}};
    run.size.in_parts = false;
    require_memory_of(run.size, tbb::this_task_arena::max_concurrency());
    run_stages(Part::input, run);
    run.size.thinned = size_of(run.points.scene);
    return run_parts(std::move(run), nullptr);
}

/// Calls run() with the thread count of the options.
template <typename Run>
Reconstruction with_threads(const Options& options, const Run& run)
{
    validate(options);
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute(run);
}

} // namespace

Gather thin_while_reading(const ThinOptions& options)
{
    if (options.merge_px == 0.0) return {};
    return [options](SceneParts& parts, const Progress& progress) {
        return thin_points(parts, options, progress);
    };
}

Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, const RunExtras& extras)
{
    return with_threads(options, [&] {
        Checkpoints checkpoints(extras.work, log);
        RunState run = {.size = size_before_thinning(read, options),
                        .checkpoints = checkpoints,
                        .wants_removed = extras.removed != nullptr,
                        .points = {std::move(thinned), {}}};
        run.size.thinned = size_of(run.points.scene);
        return run_parts(std::move(run), extras.removed);
    });
}

Reconstruction reconstruct(Scene input, const Options& options, Log& log)
{
    validate(options);
    require_consistent(input);
    return with_threads(options, [&] { return thin_and_run(std::move(input), options, log); });
}

Reconstruction reconstruct(const std::filesystem::path& input, const PointsOptions& points,
                           const Options& options, Log& log)
{
    return with_threads(options, [&] {
        const auto check = [&](const SceneSize& read) {
            require_memory_of(size_before_thinning(read, options),
                              tbb::this_task_arena::max_concurrency());
        };
        ReadModel model =
            read_found_model(input, points, log, {check, thin_while_reading(options.thin)});
        return reconstruct_thinned(std::move(model.scene), model.read, options, log);
    });
}

} // namespace vcarve
