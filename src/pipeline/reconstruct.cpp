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

/// Runs all stages after thinning.
Reconstruction run_parts(RunState run, RemovedFaces* removed)
{
    run.points.scene = center_points(std::move(run.points.scene));
    return_freed_memory();
    for (const Part part : {Part::plan, Part::points, Part::cells, Part::rays, Part::surface}) {
        run_stages(part, run);
        return_freed_memory();
    }
    run.cells = {};
    run.virtual_rays = {};
    return_freed_memory();
    run_stages(Part::refinement, run);
    if (removed != nullptr) *removed = std::move(run.carved.removed);
    return {std::move(run.points.scene), std::move(run.surface)};
}

Reconstruction thin_and_run(Scene scene, const Options& options, Log& log)
{
    RunState run = {.size = size_before_thinning(size_of(scene), options),
                    .log = log,
                    .points = {std::move(scene), {}}};
    run.size.in_parts = false;
    require_memory(run.size, tbb::this_task_arena::max_concurrency(), options.memory.limit);
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
                                   Log& log, RemovedFaces* removed)
{
    return with_threads(options, [&] {
        RunState run = {.size = size_before_thinning(read, options),
                        .log = log,
                        .wants_removed = removed != nullptr,
                        .points = {std::move(thinned), {}}};
        run.size.thinned = size_of(run.points.scene);
        return run_parts(std::move(run), removed);
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
            require_memory(size_before_thinning(read, options),
                           tbb::this_task_arena::max_concurrency(), options.memory.limit);
        };
        ReadModel model =
            read_found_model(input, points, log, {check, thin_while_reading(options.thin)});
        return reconstruct_thinned(std::move(model.scene), model.read, options, log);
    });
}

} // namespace vcarve
