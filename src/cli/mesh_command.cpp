#include "cli/mesh_command.h"

#include "base/threads.h"
#include "cli/closing_line.h"
#include "cli/expected_run.h"
#include "cli/interruption.h"
#include "cli/mesh_arguments.h"
#include "cli/mesh_report.h"
#include "cli/model_input.h"
#include "cli/placing.h"
#include "cli/preview_output.h"
#include "cli/replay.h"
#include "cli/run_memory.h"
#include "cli/run_record.h"
#include "cli/surface_check.h"
#include "cli/texture_output.h"
#include "io/colmap/sim3_text.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "mesh/check.h"
#include "options/declared.h"
#include "pipeline/memory.h"
#include "pipeline/thinned_scene.h"
#include "region/region.h"
#include "run/work_folder.h"
#include "steps/6_surface/provenance.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// What cannot be written is said before the work starts, and nothing half written stays behind.
void prepare_outputs(const std::vector<Output>& outputs, const ArrayFolder& scratch)
{
    std::vector<fs::path> parts;
    parts.reserve(outputs.size() + 1);
    for (const Output& output : outputs) {
        parts.push_back(part_path(output.path));
    }
    if (scratch.is_temporary()) parts.push_back(scratch.path());
    end_cleanly_on_signals(parts);
    for (const Output& output : outputs) {
        require_writable(output.path);
    }
}

/// What is written, and what is said of it in its file.
struct Surface {
    TriMesh mesh;
    std::vector<std::string> comments;
    Texture texture; ///< without pages where there is none
    std::optional<Provenance> provenance;
    Scene scene;          ///< the points it was made from; empty where no report tells of them
    RemovedFaces removed; ///< in the same case: what was taken away
};

/// Where it is to lie in the file.
struct Place {
    Eigen::Vector3d offset; ///< subtracted
    Eigen::Vector3d up;
};

void write_surface(const MeshArguments& arguments, const Surface& surface, const Place& place,
                   Log& log)
{
    std::vector<std::string> comments = surface.comments;
    std::optional<TriMesh> moved;
    if (arguments.transform) {
        moved = transformed(surface.mesh, *arguments.transform);
        comments.push_back("transform " + sim3_text(*arguments.transform));
        log.note(fmt::format("the coordinates written are those of the model transformed by {}",
                             arguments.output.transform));
    }
    const TriMesh& mesh = moved ? *moved : surface.mesh;
    if (!place.offset.isZero(0.0)) {
        log.note(fmt::format("the coordinates written are those of the model{} minus {}",
                             moved ? ", transformed," : "", fmt::join(place.offset, ", ")));
    }
    Stage stage(log, "write");
    const MeshFormat format = {.ascii = arguments.output.ascii,
                               .comments = comments,
                               .provenance =
                                   surface.provenance.has_value() ? &*surface.provenance : nullptr,
                               .texture = surface.texture.is_empty() ? nullptr : &surface.texture,
                               .offset = place.offset,
                               .up = place.up};
    write_mesh(arguments.out, mesh, format);
    const double share = rounding_share(arguments.out, mesh, format);
    constexpr double kSeen = 1e-6;
    if (share > kSeen) {
        log.note(
            fmt::format("the floats of {} move vertices by up to {:.1e} of the surface's size; "
                        "--offset auto avoids that",
                        arguments.out.string(), share));
    }
    stage.end({{"faces", mesh.faces.size()}, {"vertices", mesh.positions.size()}});
}

void write_stats(const fs::path& path, const Json& record)
{
    OutputFile file(path);
    file.stream() << json_text(record);
    file.commit();
}

int threads_of(const Options& options)
{
    return options.threads == 0 ? available_threads() : options.threads;
}

/// The logs of a run: what is shown, what is told of it, which goes there, too, and what was
/// counted.
struct RunLogs {
    RunLog& shown;
    Log& told;
    const CountsOfStages& counts;
};

/// A run: what it is to do, whom it tells, where its arrays are, and where its stages are kept.
struct Run {
    const MeshArguments& arguments;
    RunLogs logs;
    RunMemory& memory;
    WorkFolder* work; ///< null for nowhere
    RunRanks* ranks;  ///< null for this process alone
};

/// What a model needs is said of it. Where its size only shows when it is read, or when the points
/// of a cloud are merged, it is looked at again then.
void fit_memory(const Run& run, const RunSize& size)
{
    try {
        run.memory.fit(size, run.logs.told);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", run.arguments.model.path.string(), error.what()));
    }
}

/// All that the stages of a run depend on. What does not change before the surface is written, as
/// --offset does, is left out.
Job job_of(const MeshArguments& arguments, Log& log)
{
    Stage stage(log, "digest");
    Job job = {program_fact()};
    const Job input =
        input_facts(find_input(arguments.model.path, arguments.model.all_points()), stage);
    job.insert(job.end(), input.begin(), input.end());
    stage.end({{"files", size_of(input.size())}});
    const Job options = option_facts(arguments.options);
    job.insert(job.end(), options.begin(), options.end());
    return job;
}

/// The folder of --work, its job begun; null where there is none.
std::unique_ptr<WorkFolder> work_folder(const MeshArguments& arguments, Log& log)
{
    if (arguments.work.empty()) return nullptr;
    auto folder = std::make_unique<WorkFolder>(arguments.work);
    folder->begin(job_of(arguments, log));
    return folder;
}

/// How long it will take is said again when more is known.
void expect_run(const Run& run, const SceneSize& size, const Photographs* photographs = nullptr)
{
    const MeshArguments& arguments = run.arguments;
    ExpectedOutputs outputs = {.preview = !arguments.preview.out.empty(),
                               .report = !arguments.report.empty(),
                               .texture = arguments.texture.texture};
    if (photographs != nullptr) {
        for (const PhotographSize& photo : photographs->sizes) {
            outputs.photo_pixels += static_cast<double>(photo.width_px) * photo.height_px;
        }
    }
    run.logs.shown.expect(
        expected_run(size, arguments.options, outputs, threads_of(arguments.options)));
}

/// What is wrong with the photographs is said before the work starts.
std::optional<Photographs> photographs_if_wanted(const MeshArguments& arguments,
                                                 const ModelInput& input, const Run& run)
{
    if (!arguments.texture.reads_images()) return std::nullopt;
    Photographs photographs =
        photographs_of(arguments.texture, arguments.model.path, input.scene, run.logs.told);
    std::vector<Output> files;
    for (const fs::path& file : photographs.of_view) {
        if (!file.empty()) files.push_back({"the photograph", file});
    }
    keep_inputs(outputs_of(arguments), arguments.model, files);
    expect_run(run, input.read, &photographs);
    return photographs;
}

/// The surface of a scene. What the scene lacks is said of the model it was read from.
Surface surface_of(ModelInput input, const Run& run)
{
    const MeshArguments& arguments = run.arguments;
    try {
        Surface surface;
        Options options = arguments.options;
        options.memory = run.memory.options();
        if (run.ranks != nullptr && run.work != nullptr) {
            run.ranks->begin({run.work->job(), digest_of_options(options), run.memory.in_files()});
        }
        const std::optional<Photographs> photographs = photographs_if_wanted(arguments, input, run);
        Reconstruction made =
            reconstruct_thinned(std::move(input.scene), input.read, options, run.logs.told,
                                {.removed = arguments.report.empty() ? nullptr : &surface.removed,
                                 .work = run.work,
                                 .ranks = run.ranks});
        if (photographs) {
            const std::int64_t most = std::max<std::int64_t>(arguments.options.memory.most, 0);
            TexturedMesh covered = textured(std::move(made.mesh), made.scene, *photographs,
                                            {arguments.texture, most}, run.logs.told);
            made.mesh = std::move(covered.mesh);
            surface.texture = std::move(covered.texture);
        }
        if (arguments.output.attributes) {
            surface.provenance = find_provenance(made.mesh, made.scene);
        }
        surface.mesh = std::move(made.mesh);
        if (!arguments.report.empty()) surface.scene = std::move(made.scene);
        return surface;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", arguments.model.path.string(), error.what()));
    }
}

/// What is kept of a run when the surface is written.
struct Made {
    std::optional<ReportParts> report; ///< where one is wanted
    double long_area = 0.0;            ///< of the surface, see RunOutcome
    bool is_dense = false;             ///< the points were a cloud's
};

ModelInput read_input(const Run& run)
{
    const MeshArguments& arguments = run.arguments;
    const auto expect = [&](const SceneSize& size) { expect_run(run, size); };
    bool is_expected = false;
    const auto check = [&](const SceneSize& size) {
        fit_memory(run, size_before_thinning(size, arguments.options));
        expect(size);
        is_expected = true;
    };
    ModelInput input =
        read_model_input(arguments.model, run.logs.told,
                         {.check = check, .gather = thin_while_reading(arguments.options.thin)});
    if (!is_expected) expect(input.read);
    RunSize size = size_before_thinning(input.read, arguments.options);
    size.thinned = size_of(input.scene);
    fit_memory(run, size);
    return input;
}

/// Tells the record what the surface is, before it is written.
void check_surface(const Run& run, const TriMesh& mesh, Json& record)
{
    const MeshArguments& arguments = run.arguments;
    if (!arguments.checks && arguments.stats.empty() && arguments.report.empty()) return;
    Json& surface = record["mesh"];
    surface = checked(mesh, run.logs.counts, run.logs.told);
    require_promised(surface, arguments.command, arguments.model.path.string());
    if (!arguments.transform) return;
    const double scale = arguments.transform->scale;
    surface["area"] = surface["area"].get<double>() * scale * scale;
}

/// From the model to the file; tells the record what went in and came out.
Made make_surface(const Run& run, Json& record)
{
    const MeshArguments& arguments = run.arguments;
    const RunLogs& logs = run.logs;
    ModelInput input = read_input(run);
    const Digest digest = digest_of(input.scene);
    record["input"] = input.record;
    record["input"]["digest"] = digest_text(digest);
    PreviewOutput preview(arguments.preview);
    preview.stand_in(input.scene);
    record["preview"] = preview.record();
    const Place place = {offset_for(input.scene, arguments.output.offset, arguments.transform),
                         up_for(input.scene, arguments.output.up, arguments.transform)};
    record["offset"] = {place.offset.x(), place.offset.y(), place.offset.z()};
    if (arguments.transform) record["transform"] = sim3_text(*arguments.transform);
    Made made;
    made.is_dense = input.read.is_dense;
    Surface surface = surface_of(std::move(input), run);
    MeshArguments told = arguments;
    if (place.offset.isZero(0.0)) told.output.offset = {}; // makes no difference
    surface.comments = record_comments(told, digest);
    check_surface(run, surface.mesh, record);
    write_surface(arguments, surface, place, logs.told);
    preview.add(arguments.out.filename().string(), surface.mesh, surface.texture, logs.told);
    preview.write();
    if (!arguments.output.quiet) made.long_area = long_area(surface.mesh, RunOutcome::kLong);
    if (!arguments.report.empty()) {
        made.report =
            make_report(surface.mesh, surface.texture, surface.removed, surface.scene, logs.told);
    }
    return made;
}

std::string closing_line(const MeshArguments& arguments, const Made& made,
                         const CountsOfStages& counts)
{
    RunOutcome outcome = outcome_of(counts);
    outcome.out = arguments.out.string();
    outcome.long_area = made.long_area;
    outcome.is_dense = made.is_dense;
    outcome.has_report = !arguments.report.empty();
    return closing_line(outcome, arguments.options);
}

/// The files that tell of the run: both say the same.
void write_records(const MeshArguments& arguments, const std::optional<ReportParts>& report,
                   Json record)
{
    if (report.has_value()) record["report"] = report_json(*report, record);
    if (!arguments.stats.empty()) write_stats(arguments.stats, record);
    if (report.has_value()) write_report(arguments.report, record, *report);
}

/// From the model to the file; a run that is refused takes away what it kept, but nothing of
/// earlier runs.
Made make_or_clear(const Run& run, Json& record)
{
    try {
        return make_surface(run, record);
    } catch (const InputError&) {
        if (run.work != nullptr && !run.work->goes_on()) run.work->clear();
        throw;
    }
}

/// Ranks have nothing in common but a folder.
void require_work_folder(const MeshArguments& arguments, const Processes& processes)
{
    if (processes.all == 1 || !arguments.work.empty()) return;
    throw UsageError(fmt::format("{} ranks need --work FOLDER, on a file system that all of them "
                                 "see{}",
                                 processes.all, kSeeHelp));
}

/// What is known before the run; the rest is in its place.
Json begun_record(MeshArguments& arguments, int threads, const Processes& processes)
{
    return {{"program", program_json()},
            {"command", arguments.command},
            {"input", nullptr},
            {"output", arguments.out.string()},
            {"offset", nullptr},
            {"transform", nullptr},
            {"preview", nullptr},
            {"options",
             options_json(joined({options_of(arguments.options), options_of(arguments.output)}))},
            {"threads_used", threads},
            {"ranks", processes.all}};
}

void run(const ParsedArguments& given, RunRanks* ranks)
{
    MeshArguments arguments = read_mesh_arguments(given);
    const Processes processes = ranks == nullptr ? Processes() : ranks->processes();
    require_work_folder(arguments, processes);
    const std::array<Output, 2> others = {{{"the region", arguments.options.crop.region.file},
                                           {"the transformation", arguments.output.transform}}};
    keep_inputs(outputs_of(arguments), arguments.model, others);
    const ArrayFolder scratch(arguments.work, arguments.out);
    prepare_outputs(outputs_of(arguments), scratch);
    // What is wrong with the file of a region or a transformation is said before the work starts.
    arguments.transform = transform_of(arguments.output.transform);
    if (arguments.options.crop.region.kind == RegionChoice::Kind::file) {
        make_region(arguments.options.crop.region, Scene());
    }

    // The passes ask for as many threads as they are told; no more than this limit ever run.
    const int threads = threads_of(arguments.options);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const std::unique_ptr<RunLog> shown =
        shown_log(arguments.output.quiet, arguments.output.verbose);
    CountsKeeper keeper(*shown);
    // It resets the peak of memory that the system keeps, so it is there only where it is asked
    // for.
    std::optional<StageRecorder> recorder;
    if (!arguments.stats.empty() || !arguments.report.empty()) recorder.emplace(keeper);
    const RunLogs logs = {*shown, recorder ? static_cast<Log&>(*recorder) : keeper,
                          keeper.counts()};
    Json record = begun_record(arguments, threads, processes);

    const std::unique_ptr<WorkFolder> work = work_folder(arguments, logs.told);
    RunMemory memory(arguments.options.memory, threads, scratch, processes);
    const Made made = make_or_clear({arguments, logs, memory, work.get(), ranks}, record);
    record["memory"] = memory.record();
    if (recorder) {
        record.update(recorder->json());
        write_records(arguments, made.report, std::move(record));
    }
    if (work && !arguments.keeps_work) work->clear();
    shown->conclude(closing_line(arguments, made, keeper.counts()));
}

} // namespace

void run_mesh(const ParsedArguments& given, RunRanks* ranks)
{
    if (given.has("replay")) return print(replay_text(given.options.at("replay")));
    try {
        run(given, ranks);
    } catch (const ScratchError& error) {
        throw UsageError(error.what());
    }
}

} // namespace vcarve::cli
