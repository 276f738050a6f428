#include "vcarve/reconstruct.h"

#include "base/free_memory.h"
#include "io/input/run_input.h"
#include "model/scene_check.h"
#include "model/views.h"
#include "options/declared.h"
#include "pipeline/memory.h"
#include "pipeline/run_state.h"
#include "pipeline/scene_run.h"
#include "pipeline/stages.h"
#include "run/job.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/thin.h"
#include "vcarve/error.h"

#include <tbb/task_arena.h>

#include <type_traits>
#include <utility>

namespace vcarve {

namespace {

constexpr Part kSurfaceParts[] = {Part::plan, Part::points, Part::cells, Part::rays, Part::surface};

/// Makes the surface of points that were merged.
void make_surface(RunState& run)
{
    run.points.scene = center_points(std::move(run.points.scene));
    return_freed_memory();
    for (const Part part : kSurfaceParts) {
        run_stages(part, run);
        return_freed_memory();
    }
    run.cells = {};
    run.virtual_rays = {};
    return_freed_memory();
    run_stages(Part::refinement, run);
}

RunState state_of(Scene scene, const RunSize& size, const SceneRun& run)
{
    RunState state = {.size = size,
                      .log = run.log,
                      .wants_removed = run.wants_report,
                      .points = {std::move(scene), {}}};
    state.images = &run.images;
    state.keep_depth = run.keep_depth;
    if (!state.keep_depth) state.keep_depth = [](std::size_t, const auto& make) { return make(); };
    return state;
}

/// Merges points in memory.
void merge(Scene& scene, const SceneRun& run)
{
    const RunSize size = size_of_run(size_of(scene), run);
    RunState state = state_of(std::move(scene), size, run);
    state.size.in_parts = false;
    require_memory(state.size, tbb::this_task_arena::max_concurrency(), run.options.memory.limit);
    run_stages(Part::input, state);
    scene = std::move(state.points.scene);
}

/// The points that depth maps measure, starting from the visible surface of the sparse points.
MeasuredPoints fused_points(Scene sparse, const SceneRun& run)
{
    const RunSize size = size_of_run(size_of(sparse), run);
    RunState state = state_of(std::move(sparse), size, run);
    state.wants_removed = false;
    state.size.options.refine = {};
    state.size.options.surface = {};
    make_surface(state);
    run_stages(Part::dense, state);
    return {std::move(state.dense), {}, std::move(state.depth)};
}

/// Calls run() with the thread count of the options, and returns its result.
template <typename Run>
std::invoke_result_t<Run> with_threads(const Options& options, const Run& run)
{
    validate(options);
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute(run);
}

/// Reconstructs points that were read; with --dense, those of the photographs instead.
Reconstruction reconstruct_read(Scene scene, const SceneSize& read, const SceneRun& run)
{
    std::vector<std::string> comments = comments_of(digest_of(scene), run.options);
    SceneSize size = read;
    if (run.options.dense.dense) {
        MeasuredPoints dense = measure_dense_points(std::move(scene), run);
        scene = std::move(dense.scene);
        size = dense.read;
    }
    // NOLINTNEXTLINE(cppcoreguidelines-slicing): the data of a report are not needed
    Reconstruction made = reconstruct_thinned(std::move(scene), size, run);
    made.comments = std::move(comments);
    return made;
}

void require_sparse(const Options& options, bool is_dense)
{
    if (!options.dense.dense || !is_dense) return;
    throw UsageError("--dense and --points both supply dense points; remove one of them");
}

} // namespace

Options resolved(Options options)
{
    // Dense points lie close together, so long faces are spurious: with 0.115 faces span streets
    // from roof to roof.
    constexpr double kDenseClosing = 0.02;
    double& closing = options.surface.rules.max_closing;
    if (options.dense.dense && closing == FaceRules::kAutoClosing) closing = kDenseClosing;
    return options;
}

Gather thin_while_reading(const ThinOptions& options)
{
    if (options.merge_px == 0.0) return {};
    return [options](SceneParts& parts, const Progress& progress) {
        return thin_points(parts, options, progress);
    };
}

RunSize size_of_run(const SceneSize& read, const SceneRun& run)
{
    RunSize size = size_before_thinning(read, run.options);
    if (run.images.photographs) size.photos = run.images.photographs->sizes;
    if (run.images.masks && size.photos.empty()) size.photos = run.images.masks->sizes;
    size.measures_dense = run.options.dense.dense && !read.is_dense;
    size.has_report = run.wants_report;
    return size;
}

MeasuredPoints measure_dense_points(Scene sparse, const SceneRun& run)
{
    return with_threads(run.options, [&] {
        MeasuredPoints made = fused_points(std::move(sparse), run);
        return_freed_memory();
        if (run.take_fused) run.take_fused(made.scene);
        made.read = size_of(made.scene);
        merge(made.scene, run);
        return made;
    });
}

ReportedRun reconstruct_thinned(Scene thinned, const SceneSize& read, const SceneRun& run)
{
    return with_threads(run.options, [&] {
        RunSize size = size_of_run(read, run);
        size.thinned = size_of(thinned);
        RunState state = state_of(std::move(thinned), size, run);
        make_surface(state);
        run_stages(Part::masks, state);
        run_stages(Part::photo_refinement, state);
        run_stages(Part::texture, state);
        ReportedRun made;
        made.scene = std::move(state.points.scene);
        made.mesh = std::move(state.surface);
        made.texture = std::move(state.texture);
        made.up = up_of(made.scene);
        made.removed = std::move(state.carved.removed);
        return made;
    });
}

Reconstruction reconstruct(Scene input, const Options& options, Log& log)
{
    validate(options);
    require_consistent(input);
    require_sparse(options, input.is_dense);
    return with_threads(options, [&]() -> Reconstruction {
        const Options chosen = resolved(options);
        const RunImages images = find_images(input, chosen, {}, log);
        const SceneRun run = {chosen, images, log};
        const SceneSize read = size_of(input);
        if (read.is_dense) merge(input, run);
        return reconstruct_read(std::move(input), read, run);
    });
}

Reconstruction reconstruct(const std::filesystem::path& input, const PointsOptions& points,
                           const Options& options, Log& log)
{
    return with_threads(options, [&]() -> Reconstruction {
        const Options chosen = resolved(options);
        require_sparse(options, !points.points.empty() && points.points != "sparse");
        PointsOptions selected = points;
        if (options.dense.dense) selected.points = "sparse";
        const RunInput resolved_input = resolve_input(input, selected, chosen, false, log);
        const auto check = [&](const SceneSize& read) {
            require_memory(size_before_thinning(read, chosen),
                           tbb::this_task_arena::max_concurrency(), chosen.memory.limit);
        };
        ReadModel model =
            read_found_model(resolved_input.found, log, {check, thin_while_reading(chosen.thin)});
        return reconstruct_read(std::move(model.scene), model.read,
                                {chosen, resolved_input.images, log});
    });
}

TexturedMesh texture_mesh(const Scene& model, TriMesh mesh, const SceneRun& run)
{
    return with_threads(run.options, [&]() -> TexturedMesh {
        RunState state = state_of(model, size_of_run(size_of(model), run), run);
        state.surface = std::move(mesh);
        run_stages(Part::texture, state);
        return {std::move(state.surface), std::move(state.texture), up_of(model)};
    });
}

TriMesh refined_mesh(const Scene& model, TriMesh mesh, const SceneRun& run)
{
    return with_threads(run.options, [&] {
        RunSize size = size_of_run(size_of(model), run);
        size.measures_dense = false; // the mesh is there
        RunState state = state_of(model, size, run);
        state.surface = std::move(mesh);
        run_stages(Part::photo_refinement, state);
        run_stages(Part::texture, state);
        return std::move(state.surface);
    });
}

TexturedMesh texture(const Scene& model, TriMesh mesh, Options options, Log& log)
{
    require_consistent(model);
    options.texture.texture = true;
    options.dense = {};
    const RunImages images = find_images(model, options, {}, log);
    return texture_mesh(model, std::move(mesh), {options, images, log});
}

TexturedMesh texture(const std::filesystem::path& model, TriMesh mesh, Options options, Log& log)
{
    options.texture.texture = true;
    options.dense = {};
    const RunInput input = resolve_input(model, {.points = "sparse"}, options, false, log);
    const Scene scene = read_found_model(input.found, log).scene;
    return texture_mesh(scene, std::move(mesh), {options, input.images, log});
}

} // namespace vcarve
