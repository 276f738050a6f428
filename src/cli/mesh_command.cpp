#include "cli/mesh_command.h"

#include "base/threads.h"
#include "base/version.h"
#include "cli/closing_line.h"
#include "cli/expected_run.h"
#include "cli/interruption.h"
#include "cli/mesh_report.h"
#include "cli/model_input.h"
#include "cli/preview_output.h"
#include "cli/run_record.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "mesh/check.h"
#include "mesh/long_faces.h"
#include "page/page.h"
#include "pipeline/memory.h"
#include "pipeline/thinned_scene.h"
#include "steps/1_points/region.h"
#include "steps/5_surface/provenance.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <memory>
#include <optional>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

enum class OffsetWord { none, automatic };
constexpr const char* kOffsetWords[] = {"none", "auto"};

/// What the program writes, whatever it computes.
struct OutputOptions {
    bool ascii = false;
    bool attributes = false;
    bool quiet = false;
    WordOrVector offset; ///< one of kOffsetWords

    void visit(OptionVisitor& options)
    {
        options.stage("Output");
        options.flag(
            ascii, {.name = "ascii", .help = "Write numbers as text instead of binary; PLY only."});
        options.flag(attributes,
                     {.name = "attributes",
                      .help = "Write what vertices and faces come from: point3d_id, num_views and "
                              "error_px of each vertex, support of each face; PLY only."});
        options.word_or_vector(
            offset, kOffsetWords,
            {.name = "offset",
             .help = "What is subtracted from the coordinates that are written, and said in the "
                     "file: none; x,y,z; or auto, round numbers for a model that lies far from the "
                     "origin, so that programs that compute with floats lose nothing.",
             .min = -kUnlimited});
        options.flag(quiet, {.name = "quiet", .help = "Print nothing but errors."});
    }
};

/// Everything the command line says.
struct MeshArguments {
    ModelArguments model;
    fs::path out;
    PreviewArguments preview;
    bool with_stats = false;
    fs::path stats;
    bool with_report = false;
    fs::path report;
    std::string command; ///< as it was typed
    OutputOptions output;
    Options options;
};

std::vector<OptionRow> mesh_options()
{
    Options options;
    OutputOptions output;
    bool off = false;
    OptionTable table;
    list_points_options(table);
    options.visit(table);
    output.visit(table);
    table.path({.name = "stats",
                .help =
                    "Write options, counts, seconds and peak memory of every stage, and a check "
                    "of the mesh, as JSON. The peak that the system keeps of the process "
                    "begins anew with every stage then, so read it here."});
    list_preview_options(table);
    table.path(
        {.name = "report",
         .help = "Write a page for browsers, OUT.html, that needs no network: the surface in 3D "
                 "with cameras, points and the faces that were taken away, what every stage took, "
                 "what the filter dropped and why, and what to be wary of."});
    table.stage("Help");
    table.flag(off, {.name = "help", .help = "Print this and exit."});
    table.flag(off,
               {.name = "version", .help = "Print versions of the program and its libraries."});
    return table.rows();
}

void check_operands(const std::vector<std::string>& operands)
{
    if (operands.size() != 2) {
        std::string got = operands.empty() ? "nothing" : operands[0];
        for (std::size_t i = 1; i < operands.size(); ++i) {
            got += " " + operands[i];
        }
        throw UsageError(fmt::format("expected a model and an output, MODEL OUT.ply, but got {}{}",
                                     got, kSeeHelp));
    }
    const fs::path model = operands[0];
    const fs::path out = operands[1];
    if (is_mesh_name(model) && !is_mesh_name(out)) {
        throw UsageError(fmt::format("the model comes first and the output second: colmap-vcarve "
                                     "{} {}",
                                     out.string(), model.string()));
    }
}

void check_output(const fs::path& out, const OutputOptions& options)
{
    // What is a folder is refused as such later.
    if (!out.has_filename() || fs::is_directory(out)) return;
    require_mesh_name(out);
    if (options.ascii) require_ply(out, "--ascii");
    if (options.attributes) require_ply(out, "--attributes");
}

/// A file that is written, and what it is called in messages.
struct Output {
    const char* name;
    fs::path path;
};

std::vector<Output> outputs_of(const MeshArguments& arguments)
{
    std::vector<Output> outputs = {{"the surface", arguments.out}};
    if (!arguments.preview.out.empty()) outputs.push_back({"--preview", arguments.preview.out});
    if (arguments.with_stats) outputs.push_back({"--stats", arguments.stats});
    if (arguments.with_report) outputs.push_back({"--report", arguments.report});
    return outputs;
}

void require_distinct(const std::vector<Output>& outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (outputs[i].path != outputs[k].path) continue;
            throw UsageError(fmt::format("{} and {} cannot both be written to {}", outputs[i].name,
                                         outputs[k].name, outputs[i].path.string()));
        }
    }
}

MeshArguments read_arguments(const ParsedArguments& given)
{
    MeshArguments arguments;
    OptionReader reader(given);
    arguments.options.visit(reader);
    arguments.output.visit(reader);
    check_operands(given.operands);
    arguments.model = {given.operands[0], read_points_options(given)};
    arguments.out = given.operands[1];
    check_output(arguments.out, arguments.output);
    arguments.preview = read_preview_options(given);
    arguments.with_stats = given.has("stats");
    if (arguments.with_stats) arguments.stats = given.options.at("stats");
    arguments.with_report = given.has("report");
    if (arguments.with_report) {
        arguments.report = given.options.at("report");
        require_page_name(arguments.report);
    }
    arguments.command = command_text("colmap-vcarve", given.typed);
    require_distinct(outputs_of(arguments));
    return arguments;
}

/// What cannot be written is said before the work starts, and nothing half written stays behind.
void prepare_outputs(const std::vector<Output>& outputs)
{
    std::vector<fs::path> parts;
    parts.reserve(outputs.size());
    for (const Output& output : outputs) {
        parts.push_back(part_path(output.path));
    }
    end_cleanly_on_signals(parts);
    for (const Output& output : outputs) {
        require_writable(output.path);
    }
}

/// What is written.
struct Surface {
    TriMesh mesh;
    std::optional<Provenance> provenance;
    Scene scene;          ///< the points it was made from; empty where no report tells of them
    RemovedFaces removed; ///< in the same case: what was taken away
};

Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted)
{
    if (wanted.word == WordOrVector::kNoWord) return wanted.vector;
    const bool automatic = static_cast<OffsetWord>(wanted.word) == OffsetWord::automatic;
    return automatic ? round_offset(model) : Eigen::Vector3d::Zero();
}

void write_surface(const MeshArguments& arguments, const Surface& surface,
                   const Eigen::Vector3d& offset, Log& log)
{
    if (!offset.isZero(0.0)) {
        log.note(fmt::format("the coordinates written are those of the model minus {}",
                             fmt::join(offset, ", ")));
    }
    Stage stage(log, "write");
    const MeshFormat format = {.ascii = arguments.output.ascii,
                               .comments = {"made by colmap-vcarve " + versions().program},
                               .provenance =
                                   surface.provenance.has_value() ? &*surface.provenance : nullptr,
                               .offset = offset};
    write_mesh(arguments.out, surface.mesh, format);
    const double share = rounding_share(arguments.out, surface.mesh, format);
    constexpr double kSeen = 1e-6;
    if (share > kSeen) {
        log.note(
            fmt::format("the floats of {} move vertices by up to {:.1e} of the surface's size; "
                        "--offset auto avoids that",
                        arguments.out.string(), share));
    }
    stage.end({{"faces", surface.mesh.faces.size()}, {"vertices", surface.mesh.positions.size()}});
}

Json check_json(const MeshCheck& check)
{
    return {{"vertices", check.vertices},
            {"faces", check.faces},
            {"degenerate_faces", check.degenerate_faces},
            {"components", check.components},
            {"boundary_edges", check.boundary_edges},
            {"nonmanifold_edges", check.nonmanifold_edges},
            {"nonmanifold_vertices", check.nonmanifold_vertices},
            {"orientation_faults", check.orientation_faults},
            {"unreferenced_vertices", check.unreferenced_vertices},
            {"euler_characteristic", check.euler_characteristic},
            {"area", check.area},
            {"is_closed", check.is_closed()},
            {"is_manifold", check.is_manifold()}};
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

/// What a model needs is said of it. Where its size only shows when it is read, reconstruct() does
/// the same then.
void require_memory_of(const MeshArguments& arguments, const SceneSize& size)
{
    try {
        require_memory(size_before_thinning(size, arguments.options.thin),
                       threads_of(arguments.options), arguments.options.max_memory);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", arguments.model.path.string(), error.what()));
    }
}

/// The surface of a scene. What the scene lacks is said of the model it was read from.
Surface surface_of(ModelInput input, const MeshArguments& arguments, Log& log)
{
    try {
        Surface surface;
        Reconstruction made =
            reconstruct_thinned(std::move(input.scene), input.read, arguments.options, log,
                                arguments.with_report ? &surface.removed : nullptr);
        if (arguments.output.attributes) {
            surface.provenance = find_provenance(made.mesh, made.scene);
        }
        surface.mesh = std::move(made.mesh);
        if (arguments.with_report) surface.scene = std::move(made.scene);
        return surface;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", arguments.model.path.string(), error.what()));
    }
}

/// The logs of a run: what is shown, and what is told of it, which goes there, too.
struct RunLogs {
    RunLog& shown;
    Log& told;
};

/// What is kept of a run when the surface is written.
struct Made {
    std::optional<ReportParts> report; ///< where one is wanted
    double long_area = 0.0;            ///< of the surface, see RunOutcome
    bool is_dense = false;             ///< the points were a cloud's
};

ModelInput read_input(const MeshArguments& arguments, const RunLogs& logs)
{
    const auto expect = [&](const SceneSize& size) {
        logs.shown.expect(expected_run(
            size, arguments.options,
            {.preview = !arguments.preview.out.empty(), .report = arguments.with_report},
            threads_of(arguments.options)));
    };
    bool is_expected = false;
    ModelInput input = read_model_input(arguments.model, logs.told,
                                        {.check =
                                             [&](const SceneSize& size) {
                                                 require_memory_of(arguments, size);
                                                 expect(size);
                                                 is_expected = true;
                                             },
                                         .gather = thin_while_reading(arguments.options.thin)});
    if (!is_expected) expect(input.read);
    return input;
}

/// From the model to the file; tells the record what went in and came out.
Made make_surface(const MeshArguments& arguments, const RunLogs& logs, Json& record)
{
    ModelInput input = read_input(arguments, logs);
    record["input"] = input.record;
    PreviewOutput preview(arguments.preview);
    preview.stand_in(input.scene);
    record["preview"] = preview.record();
    const Eigen::Vector3d offset = offset_for(input.scene, arguments.output.offset);
    record["offset"] = {offset.x(), offset.y(), offset.z()};
    Made made;
    made.is_dense = input.read.is_dense;
    const Surface surface = surface_of(std::move(input), arguments, logs.told);
    write_surface(arguments, surface, offset, logs.told);
    preview.add(arguments.out.filename().string(), surface.mesh, logs.told);
    preview.write();
    if (!arguments.output.quiet) made.long_area = long_area(surface.mesh, RunOutcome::kLong);
    if (!arguments.with_stats && !arguments.with_report) return made;
    record["mesh"] = check_json(check_mesh(surface.mesh));
    if (arguments.with_report) {
        made.report = make_report(surface.mesh, surface.removed, surface.scene, logs.told);
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
    outcome.has_report = arguments.with_report;
    return closing_line(outcome, arguments.options);
}

/// The files that tell of the run: both say the same.
void write_records(const MeshArguments& arguments, const std::optional<ReportParts>& report,
                   Json record)
{
    if (report.has_value()) record["report"] = report_json(*report, record);
    if (arguments.with_stats) write_stats(arguments.stats, record);
    if (report.has_value()) write_report(arguments.report, record, *report);
}

} // namespace

Manual mesh_manual()
{
    Manual manual;
    manual.command = "colmap-vcarve";
    manual.operands = "MODEL OUT.ply";
    manual.summary = "Turns a COLMAP model into a surface.";
    manual.examples = {
        {"colmap-vcarve sparse/0 mesh.ply", "the default: a surface from any sparse model"},
        {"colmap-vcarve dense mesh.ply", "from the dense points that stereo_fusion made"},
        {"colmap-vcarve scan.ply mesh.ply", "from a laser scan that tells of its scanners"},
        {"colmap-vcarve sparse/0 mesh.ply --preview mesh.png", "with a picture of it"},
        {"colmap-vcarve --closed sparse/0 mesh.ply", "a watertight one, without holes"},
        {"colmap-vcarve sparse/0 mesh.glb", "one for browsers and engines"},
        {"colmap-vcarve sparse/0 mesh.ply --report run.html", "and a page to look at it with"},
        {"colmap-vcarve --crop auto sparse/0 mesh.ply", "of what was looked at, without the rest"},
    };
    manual.operand_meanings = {
        {"MODEL",
         "A folder with cameras, images and points3D (.bin or .txt), a folder of such "
         "models, or a workspace that holds sparse/0 or sparse; with fused.ply and "
         "fused.ply.vis, as stereo_fusion leaves them, the dense points are taken. Or a PLY file: "
         "of a dense workspace, or of a laser scan with the places of its scanners."},
        {"OUT.ply",
         "The surface: triangles with colours and normals, in the model's frame. The end "
         "of the name says the format: .ply, .obj, .off (no normals), .stl (neither "
         "colours nor normals of vertices) or .glb (binary glTF)."},
    };
    manual.footnotes = {
        {"colmap-vcarve compare",
         "Measures surfaces against a model, the truth or COLMAP's own; see colmap-vcarve compare "
         "--help."},
        {"What it prints",
         "One line a stage on stderr, and at the end how much of what the views look at is open "
         "(lines of sight through all images that meet no face where the closed surface has one) "
         "and what to try. On terminals a bar of the whole run, if that takes over 5 seconds. "
         "NO_COLOR suppresses bold letters."},
        {"Exit code", "0 done, 1 internal error, 2 wrong usage or output, 3 wrong input."},
    };
    manual.options = mesh_options();
    return manual;
}

void run_mesh(const ParsedArguments& given)
{
    const MeshArguments arguments = read_arguments(given);
    prepare_outputs(outputs_of(arguments));
    // What is wrong with the file of a region is said before the work starts.
    if (arguments.options.crop.region.kind == RegionChoice::Kind::file) {
        make_region(arguments.options.crop.region, Scene());
    }

    // The passes ask for as many threads as they are told; no more than this limit ever run.
    const int threads = threads_of(arguments.options);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const std::unique_ptr<RunLog> shown = shown_log(arguments.output.quiet);
    CountsKeeper keeper(*shown);
    // It resets the peak of memory that the system keeps, so it is there only where it is asked
    // for.
    std::optional<StageRecorder> recorder;
    if (arguments.with_stats || arguments.with_report) recorder.emplace(keeper);
    const RunLogs logs = {*shown, recorder ? static_cast<Log&>(*recorder) : keeper};
    Json record = {{"program", program_json()},
                   {"command", arguments.command},
                   {"input", nullptr},
                   {"output", arguments.out.string()},
                   {"offset", nullptr},
                   {"preview", nullptr},
                   {"options", options_json(arguments.options)},
                   {"threads_used", threads}};
    record["options"].update(options_json(arguments.output));

    const Made made = make_surface(arguments, logs, record);
    if (recorder) {
        record.update(recorder->json());
        write_records(arguments, made.report, std::move(record));
    }
    shown->conclude(closing_line(arguments, made, keeper.counts()));
}

} // namespace vcarve::cli
