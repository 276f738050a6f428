#include "base/stage_counts.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/commands.h"
#include "cli/console_log.h"
#include "cli/exit_code.h"
#include "cli/input_output.h"
#include "cli/mesh_arguments.h"
#include "cli/mesh_report.h"
#include "cli/picture_output.h"
#include "cli/run_memory.h"
#include "cli/run_record.h"
#include "cli/shared_work.h"
#include "io/colmap/sim3_text.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "mesh/check.h"
#include "model/views.h"
#include "options/declared.h"
#include "pipeline/memory.h"
#include "pipeline/thinned_scene.h"
#include "region/region.h"
#include "run/work_folder.h"
#include "steps/1_points/thin.h"
#include "steps/6_surface/provenance.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

namespace vcarve::cli {

namespace {

constexpr int kStatsSchema = 3; ///< version of --stats; increased if keys change

namespace fs = std::filesystem;

/// The output of a run.
struct Surface {
    TriMesh mesh;
    std::vector<std::string> comments;
    Texture texture; ///< may have no pages
    std::optional<Provenance> provenance;
    Scene scene;          ///< the input points; empty without a report
    DepthPicture depth;   ///< empty without --dense
    RemovedFaces removed; ///< empty without a report
};

/// The frame of the mesh file.
struct Place {
    std::optional<Similarity> transform; ///< applied to the model first
    Eigen::Vector3d offset;              ///< then subtracted
    Eigen::Vector3d up;
};

/// The frame of the mesh file. Notes the up direction if the images leave it ambiguous.
Place place_for(const Scene& model, const MeshArguments& arguments, Log& log)
{
    const OutputOptions& output = arguments.output;
    Place place = {arguments.transform, {}, up_for(model, output.up, arguments.transform)};
    const bool is_used = output.upright || lower_case_end(arguments.out) == ".glb";
    if (is_used && output.up.word == static_cast<int>(UpWord::automatic) &&
        look_in_one_direction(model)) {
        const Eigen::Vector3d shown = (place.up * 100.0).array().round() / 100.0 + 0.0; // no -0.00
        log.note(fmt::format("all cameras look one way, so the top of their images is used as up, "
                             "direction {:.2f}; if they look straight down, use --up back",
                             fmt::join(shown, ", ")));
    }
    if (output.upright) {
        place.transform = turned_upright(place.transform, place.up);
        place.up = Eigen::Vector3d::UnitZ();
    }
    place.offset = offset_for(model, output.offset, place.transform);
    return place;
}

void write_surface(const MeshArguments& arguments, const Surface& surface, const Place& place,
                   Log& log)
{
    std::vector<std::string> comments = surface.comments;
    std::optional<TriMesh> moved;
    if (place.transform) {
        moved = transformed(surface.mesh, *place.transform);
        comments.push_back("transform " + sim3_text(*place.transform));
        log.note(
            fmt::format("output coordinates are those of the model{}{}",
                        arguments.transform ? " transformed by " + arguments.output.transform : "",
                        arguments.output.upright ? ", rotated so that z is up" : ""));
    }
    const TriMesh& mesh = moved ? *moved : surface.mesh;
    if (!place.offset.isZero(0.0)) {
        log.note(fmt::format("output coordinates are those of the model{} minus {}",
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
            fmt::format("32-bit floats in {} move vertices by up to {:.1e} of the mesh's size; "
                        "use --offset auto",
                        arguments.out.string(), share));
    }
    stage.end({{counts::kOutput.faces, size_of(mesh.faces.size())},
               {counts::kOutput.vertices, size_of(mesh.positions.size())}});
}

void write_stats(const fs::path& path, const Json& record)
{
    OutputFile file(path);
    file.stream() << json_text(record);
    file.commit();
}

/// The parts of a run.
struct Run {
    const MeshArguments& arguments;
    ConsoleLog& shown;
    Log& log; ///< forwards to `shown`
    RunMemory& memory;
    const fs::path& temporary;         ///< the folder of tiles without --work
    std::unique_ptr<WorkFolder>& work; ///< null until there are files to keep
};

/// Plans the memory; called again when the size is known better. Errors name the model.
void fit_memory(const Run& run, const RunSize& size)
{
    try {
        run.memory.fit(size, run.log);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", run.arguments.model.path.string(), error.what()));
    }
}

/// --max-memory in bytes; 0 if it is `auto`.
std::int64_t memory_limit(const MeshArguments& arguments)
{
    return std::max<std::int64_t>(arguments.options.memory.limit, 0);
}

/// The images that a run reads, if any.
struct RunImages {
    std::optional<Photographs> photographs;
    std::optional<Photographs> masks;
};

/// Finds the images, to report their errors before the work starts.
RunImages find_images(const MeshArguments& arguments, const Scene& scene, Log& log)
{
    RunImages found;
    std::vector<Output> files;
    found.masks = masks_of(arguments.texture, scene, log);
    if (found.masks) files = files_of(*found.masks);
    if (arguments.dense.dense || arguments.texture.reads_images()) {
        found.photographs = photographs_of(arguments.texture, arguments.model.path, scene, log);
        if (found.masks) found.photographs->masks = found.masks->of_view;
        std::ranges::move(files_of(*found.photographs), std::back_inserter(files));
        require_photo_memory(*found.photographs, memory_limit(arguments));
    }
    if (!files.empty()) keep_inputs(outputs_of(arguments), arguments.model, files);
    return found;
}

/// Replaces the sparse points by dense points measured in the photographs. Returns the picture of a
/// depth map.
DepthPicture make_dense(ModelInput& input, const Photographs& photographs, const Run& run)
{
    const MeshArguments& arguments = run.arguments;
    Options options = arguments.options;
    options.refine = {};
    options.surface = {}; // depth maps always start from the visible surface
    const Reconstruction sparse =
        reconstruct_thinned(std::move(input.scene), input.read, options, run.log);
    DensePoints dense =
        measure_dense_points({arguments.dense, photographs,
                              allowed_memory(arguments.options.memory), run.work.get(), run.log},
                             sparse);
    if (!arguments.dense.keep_points.empty()) {
        const FoundInput found = find_input(arguments.model.path, arguments.model.all_points());
        write_points(arguments.dense.keep_points, dense.scene, found.model);
    }
    Stage stage(run.log, "merge");
    input.read = size_of(dense.scene);
    input.scene = thin_points(dense.scene, options.thin, stage);
    stage.end({{counts::kMerge.points, size_of(input.scene.num_points()),
                size_of(dense.scene.num_points())}});
    RunSize size = size_before_thinning(input.read, arguments.options);
    size.thinned = size_of(input.scene);
    fit_memory(run, size);
    return std::move(dense.picture);
}

/// Divides a model of which memory has all points or a sample.
void plan_tiles(ModelInput input, std::size_t most, TiledRun& tiles)
{
    PointSample sample = {.scene = without_points(input.scene)};
    if (input.one_in > 1) {
        sample = {.scene = input.scene, .one_in = input.one_in, .points = input.read.points};
    } else {
        sample.add(input.scene);
    }
    const auto read = [&](std::size_t part, const TakePoints& take, const Progress& progress) {
        read_points(input, part, take, progress);
    };
    tiles.plan(sample, read, most);
}

TriMesh surface_in_tiles(ModelInput input, const Run& run)
{
    if (!run.work) {
        run.work = std::make_unique<WorkFolder>(run.temporary);
        run.work->begin({program_fact()});
    }
    const Options options = options_of_tiles(run.arguments);
    TiledRun tiles(*run.work, options, run.log);
    plan_tiles(std::move(input), run.memory.tile_points(), tiles);
    return tiles.make();
}

/// Makes the surface of a scene. Errors name the model.
Surface surface_of(ModelInput input, const Run& run)
{
    const MeshArguments& arguments = run.arguments;
    const RunImages images = find_images(arguments, input.scene, run.log);
    try {
        Surface surface;
        if (arguments.dense.dense) surface.depth = make_dense(input, *images.photographs, run);
        if (run.memory.tile_points() > 0) {
            surface.mesh = surface_in_tiles(std::move(input), run);
            return surface;
        }
        Reconstruction made =
            reconstruct_thinned(std::move(input.scene), input.read, arguments.options, run.log,
                                arguments.report.empty() ? nullptr : &surface.removed);
        if (images.masks) made.mesh = unmasked(made.mesh, made.scene, *images.masks, run.log);
        if (images.photographs) {
            TexturedMesh covered = textured(std::move(made.mesh), made.scene, *images.photographs,
                                            {arguments.texture, memory_limit(arguments)}, run.log);
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

/// The results of a run besides the mesh.
struct Made {
    std::optional<ReportParts> report;
    double long_area = 0.0; ///< see RunOutcome
    bool is_dense = false;  ///< the points are a dense cloud
    bool takes_nearest_views = false;
};

ModelInput read_input(const Run& run)
{
    const MeshArguments& arguments = run.arguments;
    const auto check = [&](const SceneSize& size) {
        fit_memory(run, size_before_thinning(size, arguments.options));
    };
    ModelInput input =
        read_model_input(arguments.model, run.log,
                         {.check = check,
                          .gather = thin_while_reading(arguments.options.thin),
                          .wants_sample = [&](const std::optional<SceneSize>& /*size*/) {
                              return run.memory.tile_points() > 0 && !arguments.dense.dense;
                          }});
    RunSize size = size_before_thinning(input.read, arguments.options);
    size.thinned = size_of(input.scene);
    fit_memory(run, size);
    return input;
}

/// Adds the check of the mesh to the record, before the mesh is written.
void check_surface(const Run& run, const TriMesh& mesh, Json& record)
{
    const MeshArguments& arguments = run.arguments;
    if (!arguments.checks && arguments.stats.empty() && arguments.report.empty()) return;
    Json& surface = record["mesh"];
    surface = checked(mesh, run.shown.counts(), run.log);
    require_promised(surface, arguments.command, arguments.model.path.string());
    if (!arguments.transform) return;
    const double scale = arguments.transform->scale;
    surface["area"] = surface["area"].get<double>() * scale * scale;
}

/// Makes and writes the mesh; completes the record.
Made make_surface(const Run& run, Json& record)
{
    const MeshArguments& arguments = run.arguments;
    ModelInput input = read_input(run);
    const Digest digest = digest_of(input.scene);
    record["input"] = input.record;
    record["input"]["digest"] = digest_text(digest);
    PreviewOutput preview(arguments.preview);
    preview.set_scene(input.scene);
    record["preview"] = preview.record();
    const Place place = place_for(input.scene, arguments, run.log);
    record["offset"] = {place.offset.x(), place.offset.y(), place.offset.z()};
    if (place.transform) record["transform"] = sim3_text(*place.transform);
    Made made;
    made.is_dense = input.read.is_dense;
    made.takes_nearest_views = input.found.takes_nearest_views();
    Surface surface = surface_of(std::move(input), run);
    MeshArguments recorded = arguments;
    if (place.offset.isZero(0.0)) recorded.output.offset = {}; // has no effect
    surface.comments = record_comments(recorded, digest, run.memory.tile_points());
    check_surface(run, surface.mesh, record);
    write_surface(arguments, surface, place, run.log);
    preview.add(arguments.out.filename().string(), surface.mesh, surface.texture, run.log);
    preview.write();
    if (!arguments.output.quiet) made.long_area = long_area(surface.mesh, RunOutcome::kLong);
    if (!arguments.report.empty()) {
        made.report = make_report(
            {surface.mesh, surface.texture, surface.removed, surface.scene, surface.depth},
            run.log);
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
    outcome.takes_nearest_views = made.takes_nearest_views;
    outcome.has_report = !arguments.report.empty();
    return closing_line(outcome, arguments.options);
}

void write_records(const MeshArguments& arguments, const std::optional<ReportParts>& report,
                   Json record)
{
    if (report.has_value()) record["report"] = report_json(*report, record);
    if (!arguments.stats.empty()) write_stats(arguments.stats, record);
    if (report.has_value()) write_report(arguments.report, record, *report);
}

/// Makes the mesh. If it fails, removes files that no later run can use.
Made make_or_clear(const Run& run, Json& record)
{
    try {
        return make_surface(run, record);
    } catch (const InputError&) {
        if (run.work && !run.work->is_resumed()) run.work->clear();
        throw;
    } catch (...) {
        if (run.work && run.arguments.work.empty()) run.work->clear();
        throw;
    }
}

/// The record at the start of the run.
Json begun_record(MeshArguments& arguments, int threads)
{
    return {{"schema", kStatsSchema},
            {"program", program_json()},
            {"command", arguments.command},
            {"input", nullptr},
            {"output", arguments.out.string()},
            {"offset", nullptr},
            {"transform", nullptr},
            {"preview", nullptr},
            {"options",
             options_json(joined({options_of(arguments.options), options_of(arguments.output)}))},
            {"threads_used", threads}};
}

} // namespace

void run_mesh(const ParsedArguments& given)
{
    MeshArguments arguments = read_mesh_arguments(given);
    const std::array<Output, 2> others = {{{"the region", arguments.options.crop.region.file},
                                           {"the transformation", arguments.output.transform}}};
    keep_inputs(outputs_of(arguments), arguments.model, others);
    const fs::path temporary = folder_beside(arguments.out);
    prepare_outputs(outputs_of(arguments), arguments.work.empty() ? temporary : fs::path());
    // Errors in these files are reported before the work starts.
    arguments.transform = transform_of(arguments.output.transform, arguments.model);
    if (arguments.options.crop.region.kind == RegionChoice::Kind::file) {
        make_region(arguments.options.crop.region, Scene());
    }
    check_images(arguments.model, arguments.texture,
                 arguments.dense.dense || arguments.texture.reads_images(), arguments.preview);

    const int threads = threads_or_all(arguments.options.threads);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    ConsoleLog shown(console_on_stderr(arguments.output.quiet, arguments.output.verbose));
    // It resets the process's peak memory, so it is created only if needed.
    std::optional<StageRecorder> recorder;
    if (!arguments.stats.empty() || !arguments.report.empty()) recorder.emplace(shown);
    Log& log = recorder ? static_cast<Log&>(*recorder) : shown;
    Json record = begun_record(arguments, threads);

    std::unique_ptr<WorkFolder> work = open_work(arguments, log);
    if (work && has_helped(arguments, *work, log)) {
        return shown.conclude(fmt::format("another process wrote {}; this one made some of its "
                                          "tiles",
                                          arguments.out.string()));
    }
    RunMemory memory(arguments, threads);
    const Made made = make_or_clear({arguments, shown, log, memory, temporary, work}, record);
    record["memory"] = memory.record();
    if (recorder) {
        record.update(recorder->json());
        write_records(arguments, made.report, std::move(record));
    }
    if (work && !arguments.keeps_work) work->clear();
    shown.conclude(closing_line(arguments, made, shown.counts()));
}

} // namespace vcarve::cli
