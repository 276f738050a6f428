#include "base/threads.h"
#include "cli/commands.h"
#include "cli/console_log.h"
#include "cli/exit_code.h"
#include "cli/input_output.h"
#include "cli/mesh_output.h"
#include "cli/mesh_report.h"
#include "cli/picture_output.h"
#include "cli/run_record.h"
#include "io/colmap/sim3_text.h"
#include "io/files/output_file.h"
#include "mesh/check.h"
#include "picture/eye.h"
#include "region/region.h"
#include "run/job.h"
#include "tiles/model_run.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

constexpr int kStatsSchema = 3; ///< version of --stats; increased if keys change

/// Finds the input. Reports errors in small files before the work starts.
RunInput resolved_input(MeshArguments& arguments, const std::vector<Output>& outputs, Log& log)
{
    RunInput input = resolve_input(arguments.model.path, arguments.model.all_points(),
                                   arguments.options, needs_view(arguments.preview), log);
    keep_inputs(outputs, input,
                {{"the region", arguments.options.crop.region.file},
                 {"the transformation", arguments.output.transform}});
    arguments.transform = transform_of(arguments.output.transform, input.found.model);
    if (arguments.options.crop.region.kind == RegionChoice::Kind::file) {
        make_region(arguments.options.crop.region, Scene());
    }
    if (!input.views.views.empty() && needs_view(arguments.preview)) {
        named_view(input.views, arguments.preview.view);
    }
    return input;
}

RunPlan plan_of(const MeshArguments& arguments, const std::filesystem::path& scratch)
{
    return {.work = arguments.work.empty() ? nullptr : std::make_unique<WorkFolder>(arguments.work),
            .keeps_work = arguments.keeps_work,
            .scratch = scratch,
            .keep_points = arguments.keep_points,
            .tile_points = static_cast<std::size_t>(arguments.tile_points),
            .needs_one_piece = option_of_one_piece(arguments) != nullptr,
            .wants_report = !arguments.report.empty()};
}

/// The record of a run before its stages.
Json begun_record(MeshArguments& arguments, const RunInput& input, const ReadModel& model)
{
    return {{"schema", kStatsSchema},
            {"program", program_json()},
            {"command", arguments.command},
            {"input", input_json(input, model)},
            {"output", arguments.out.string()},
            {"offset", nullptr},
            {"transform", nullptr},
            {"preview", nullptr},
            {"options",
             options_json(joined({options_of(arguments.options), options_of(arguments.output)}))},
            {"threads_used", threads_or_all(arguments.options.threads)}};
}

/// Checks the mesh for the record, before it is written.
void check_surface(const MeshArguments& arguments, const TriMesh& mesh, const ConsoleLog& shown,
                   Log& log, Json& record)
{
    if (!arguments.checks && arguments.stats.empty() && arguments.report.empty()) return;
    Json& surface = record["mesh"];
    surface = checked(mesh, shown.counts(), log);
    require_promised(surface, arguments.command, arguments.model.path.string());
    if (!arguments.transform) return;
    const double scale = arguments.transform->scale;
    surface["area"] = surface["area"].get<double>() * scale * scale;
}

void write_stats(const std::filesystem::path& path, const Json& record)
{
    OutputFile file(path);
    file.stream() << json_text(record);
    file.commit();
}

} // namespace

void run_mesh(const ParsedArguments& given)
{
    MeshArguments arguments = read_mesh_arguments(given);
    limit_threads(arguments.options.threads);
    ConsoleLog shown(console_on_stderr(arguments.output.quiet, arguments.output.verbose));
    // It resets the process's peak memory, so it is created only if needed.
    std::optional<StageRecorder> recorder;
    if (!arguments.stats.empty() || !arguments.report.empty()) recorder.emplace(shown);
    Log& log = recorder ? static_cast<Log&>(*recorder) : shown;

    const std::filesystem::path scratch = folder_beside(arguments.out);
    const std::vector<Output> outputs = outputs_of(arguments);
    prepare_outputs(outputs, arguments.work.empty() ? scratch : std::filesystem::path());
    RunPlan plan = plan_of(arguments, scratch);
    const RunInput input = resolved_input(arguments, outputs, log);
    ModelRun run(input, arguments.options, std::move(plan), log);
    if (run.is_made_by_another(arguments.out)) {
        return shown.conclude(fmt::format("another process wrote {}; this one made some of its "
                                          "tiles",
                                          arguments.out.string()));
    }

    ReadModel model = run.read();
    Json record = begun_record(arguments, input, model);
    const Digest digest = digest_of(model.scene);
    record["input"]["digest"] = digest_text(digest);
    PreviewOutput preview(arguments.preview);
    preview.set_scene(model.scene);
    record["preview"] = preview.record();
    const OutputFrame frame = frame_of(model.scene, arguments, log);
    record["offset"] = {frame.offset.x(), frame.offset.y(), frame.offset.z()};
    if (frame.transform) record["transform"] = sim3_text(*frame.transform);
    RunOutcome outcome = {.out = arguments.out.string(),
                          .is_dense = model.read.is_dense,
                          .takes_nearest_views = model.found.takes_nearest_views(),
                          .has_report = !arguments.report.empty()};

    ReportedRun made = run.make(std::move(model));
    made.comments = comments_of(digest, arguments, frame, run.memory().tile_points());
    check_surface(arguments, made.mesh, shown, log, record);
    write_surface(arguments, made, frame, log);
    preview.add(arguments.out.filename().string(), made.mesh, made.texture, log);
    preview.write();
    if (!arguments.output.quiet) outcome.long_area = long_area(made.mesh, RunOutcome::kLong);
    std::optional<ReportParts> report;
    if (!arguments.report.empty()) report = make_report(made, log);
    record["memory"] = {{"tile_points", run.memory().tile_points()},
                        {"needed_bytes", run.memory().needed()},
                        {"allowed_bytes", run.memory().allowed()}};
    if (recorder) record.update(recorder->json());
    if (report) record["report"] = report_json(*report, record);
    if (!arguments.stats.empty()) write_stats(arguments.stats, record);
    if (report) write_report(arguments.report, record, *report);
    run.end();
    shown.conclude(closing_line(outcome_of(shown.counts(), outcome), arguments.options));
}

} // namespace vcarve::cli
