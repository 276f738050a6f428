#include "tiles/model_run.h"

#include "base/stage_counts.h"
#include "base/threads.h"
#include "io/dense/visibility.h"
#include "run/job.h"
#include "steps/1_points/thin.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace vcarve {

// Depth maps are kept in files. Planes are written as in memory.
template <>
inline constexpr bool kIsPlain<PixelPlane> = true;
template <>
inline constexpr int kNumFields<DepthMap> = 4;

namespace fs = std::filesystem;

namespace {

/// Divides a model of which memory has all points or a sample.
void plan_tiles(ReadModel model, std::size_t most, TiledRun& tiles)
{
    PointSample sample = {.scene = without_points(model.scene)};
    if (model.one_in > 1) {
        sample = {.scene = model.scene, .one_in = model.one_in, .points = model.read.points};
    } else {
        sample.add(model.scene);
    }
    const auto read = [&](std::size_t part, const TakePoints& take, const Progress& progress) {
        read_points(model, part, take, progress);
    };
    tiles.plan(sample, read, most);
}

} // namespace

ModelRun::ModelRun(const RunInput& input, const Options& options, RunPlan plan, Log& log)
    : input_(input),
      options_(options),
      plan_(std::move(plan)),
      log_(log),
      run_{.options = options,
           .images = input.images,
           .log = log,
           .wants_report = plan_.wants_report},
      memory_(options.memory, plan_.tile_points, plan_.needs_one_piece,
              threads_or_all(options.threads))
{
    run_.keep_depth = [this](std::size_t photo, const auto& make) {
        return kept_depth(photo, make);
    };
    if (!plan_.keep_points.empty()) {
        run_.take_fused = [this](const Scene& fused) {
            write_dense_points(plan_.keep_points, fused, input_.file_order);
        };
    }
    if (!plan_.work) return;
    if (!plan_.work->leads() && plan_.tile_points == 0) { // only tiles can be shared
        throw InputError(fmt::format("another run uses the work folder {}; wait until it ends, or "
                                     "choose another folder with --work",
                                     plan_.work->path().string()));
    }
    plan_.work->begin(job());
}

ModelRun::~ModelRun()
{
    if (is_temporary_) plan_.work->clear();
}

/// Everything that the kept files depend on. Options such as --offset take effect later.
Job ModelRun::job() const
{
    Stage stage(log_, "digest");
    const Progress progress = stage;
    const bool is_dense = options_.dense.dense;
    Job job = {program_fact()};
    const auto add = [&](const Job& facts) { job.insert(job.end(), facts.begin(), facts.end()); };
    add(input_facts(input_.found, progress.part(0.0, is_dense ? 0.1 : 1.0)));
    if (is_dense) {
        add(image_facts("photograph", *input_.images.photographs, progress.part(0.1, 0.9)));
        if (input_.images.masks) {
            add(image_facts("mask", *input_.images.masks, progress.part(0.9, 1.0)));
        }
    }
    stage.end({{counts::kPlan.files, size_of(job.size() - 1)}});
    add(option_facts(options_));
    if (plan_.tile_points > 0) {
        job.push_back({"--tile-points", std::to_string(plan_.tile_points)});
    }
    return job;
}

bool ModelRun::is_made_by_another(const fs::path& out)
{
    if (!plan_.work || plan_.work->leads()) return false;
    const Options options = options_of_tiles();
    if (!TiledRun(*plan_.work, options, log_).help()) return false;
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(out, error);
    if (error || written < plan_.work->began()) {
        throw InputError(fmt::format("{}: the process that led the run has ended without it; its "
                                     "messages say why",
                                     out.string()));
    }
    return true;
}

/// Plans the memory; called again when the size is known better. Errors name the model.
void ModelRun::fit_memory(const RunSize& size)
{
    try {
        memory_.fit(size, log_);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", input_.path.string(), error.what()));
    }
}

ReadModel ModelRun::read()
{
    const auto check = [&](const SceneSize& size) { fit_memory(size_of_run(size, run_)); };
    ReadModel model =
        read_found_model(input_.found, log_,
                         {.check = check,
                          .gather = thin_while_reading(options_.thin),
                          .wants_sample = [&](const std::optional<SceneSize>& /*size*/) {
                              return memory_.tile_points() > 0 && !options_.dense.dense;
                          }});
    RunSize size = size_of_run(model.read, run_);
    size.thinned = size_of(model.scene);
    fit_memory(size);
    return model;
}

/// Returns make(), or its result of an earlier run if the folder has it intact.
DepthMap ModelRun::kept_depth(std::size_t photo, const std::function<DepthMap()>& make) const
{
    if (!plan_.work) return make();
    const std::string name = fmt::format("depth-{}", photo);
    try {
        DepthMap kept;
        if (plan_.work->has(name)) {
            plan_.work->load(name, kept);
            return kept;
        }
    } catch (const InputError&) { // damaged; make() computes the same bytes again
    }
    DepthMap made = make();
    plan_.work->save(name, made);
    return made;
}

Options ModelRun::options_of_tiles() const
{
    Options options = options_; // the limit applies to each tile
    options.memory.limit = allowed_memory(options.memory).value_or(0);
    return options;
}

ReportedRun ModelRun::make(ReadModel model)
{
    try {
        return made_of(std::move(model));
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", input_.path.string(), error.what()));
    }
}

ReportedRun ModelRun::made_of(ReadModel model)
{
    DepthPicture depth;
    if (options_.dense.dense) {
        MeasuredPoints dense = measure_dense_points(std::move(model.scene), run_);
        depth = std::move(dense.depth);
        model.scene = std::move(dense.scene);
        model.read = dense.read;
        RunSize size = size_of_run(model.read, run_);
        size.thinned = size_of(model.scene);
        memory_.fit(size, log_);
    }
    ReportedRun made = memory_.tile_points() > 0
                           ? made_in_tiles(std::move(model))
                           : reconstruct_thinned(std::move(model.scene), model.read, run_);
    made.depth = std::move(depth);
    return made;
}

ReportedRun ModelRun::made_in_tiles(ReadModel model)
{
    if (!plan_.work) {
        plan_.work = std::make_unique<WorkFolder>(plan_.scratch);
        is_temporary_ = true;
        plan_.work->begin({program_fact()});
    }
    if (options_.dense.dense && options_.dense.refine_px > 0) {
        log_.note("the mesh is not refined by the photographs, because it is made in tiles");
    }
    const Options options = options_of_tiles();
    TiledRun tiles(*plan_.work, options, log_);
    plan_tiles(std::move(model), memory_.tile_points(), tiles);
    ReportedRun made;
    made.mesh = tiles.make();
    return made;
}

void ModelRun::end()
{
    if (plan_.work && !plan_.keeps_work) plan_.work->clear();
}

} // namespace vcarve
