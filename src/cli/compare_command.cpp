#include "base/text.h"
#include "cli/baseline_runs.h"
#include "cli/commands.h"
#include "cli/compare_outputs.h"
#include "cli/console_log.h"
#include "cli/exit_code.h"
#include "cli/input_output.h"
#include "cli/picture_output.h"
#include "cli/run_record.h"
#include "compare/comparison_table.h"
#include "compare/evidence.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "io/ply/ply_file.h"
#include "options/declared.h"
#include "picture/eye.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSeeCompareHelp = " (see colmap-vcarve compare --help)";

/// The parsed command line.
struct CompareArguments {
    ModelArguments model;
    std::vector<fs::path> meshes;
    fs::path truth; ///< empty if not given
    CompareOutputs outputs;
    std::string command; ///< as typed
    CompareOptions measure;
    fs::path colmap; ///< empty if not run
    BaselineRunOptions colmap_run;
    ConsoleArguments console;
    HelpOptions help;
};

OptionList truth_options(CompareArguments& arguments)
{
    return {{"Measurement",
             {.name = "truth",
              .help = "Add accuracy against the true surface. FILE is a PLY in the model's frame; "
                      "the figures are precision, recall, F and blocked rays."},
             &arguments.truth}};
}

OptionList baseline_options(CompareArguments& arguments)
{
    constexpr const char* kBaseline = "COLMAP";
    return {
        {kBaseline,
         {.name = "colmap",
          .help = "Run COLMAP's mesher and this program, too. FILE is COLMAP's program. Each "
                  "adds a column with seconds and peak memory."},
         &arguments.colmap},
        {kBaseline,
         {.name = "colmap-timeout",
          .unit = "s",
          .help = "Stop COLMAP after N s. Its mesher never ends on some models.",
          .min = 1},
         &arguments.colmap_run.timeout_s},
    };
}

OptionList options_of(CompareArguments& arguments)
{
    return joined({options_of(arguments.model), truth_options(arguments),
                   vcarve::options_of(arguments.measure), baseline_options(arguments),
                   output_options(arguments.outputs),
                   cli::options_of(arguments.console, "Print only the table and errors."),
                   cli::options_of(arguments.help)});
}

CompareArguments read_arguments(const ParsedArguments& given)
{
    CompareArguments arguments;
    read_options(given, options_of(arguments));
    const bool makes_meshes = !arguments.colmap.empty();
    if (given.operands.size() < (makes_meshes ? 1U : 2U)) {
        throw UsageError(
            given.operands.empty()
                ? fmt::format("missing MODEL and meshes{}", kSeeCompareHelp)
                : fmt::format("missing meshes after {}{}", given.operands[0], kSeeCompareHelp));
    }
    arguments.model.path = given.operands[0];
    arguments.meshes.assign(given.operands.begin() + 1, given.operands.end());
    check_names(arguments.outputs, given);
    arguments.command = command_text("colmap-vcarve compare", given.typed);
    return arguments;
}

/// Reports unreadable inputs and unwritable outputs before the work starts. Returns the model.
RunInput checked_input(const CompareArguments& arguments, Log& log)
{
    const PreviewArguments& preview = arguments.outputs.preview;
    RunInput model = resolve_input(arguments.model.path, arguments.model.all_points(), {},
                                   needs_view(preview), log);
    std::vector<fs::path> inputs = arguments.meshes;
    if (!arguments.truth.empty()) inputs.push_back(arguments.truth);
    check_outputs(arguments.outputs, model, inputs);
    if (!model.views.views.empty()) named_view(model.views, preview.view);
    for (const fs::path& input : inputs) {
        if (is_mesh_name(input) && lower_case_end(input) != ".ply") {
            throw UsageError(fmt::format("{}: compare reads PLY files only", input.string()));
        }
        read_ply_header(input);
    }
    return model;
}

/// Removes partial files if a signal ends the run.
void remove_on_signals(const CompareArguments& arguments, const ScratchFolder* scratch)
{
    std::vector<fs::path> unfinished;
    if (scratch != nullptr) unfinished.push_back(scratch->path());
    for (const fs::path& output : arguments.outputs.paths()) {
        unfinished.push_back(part_path(output));
    }
    end_cleanly_on_signals(unfinished);
}

/// The meshes of COLMAP and of this program; empty without --colmap.
std::vector<BaselineMesh> baselines_of(const CompareArguments& arguments, const FoundInput& found,
                                       Log& log)
{
    if (arguments.colmap.empty()) return {};
    const ScratchFolder scratch;
    remove_on_signals(arguments, &scratch);
    return run_baselines({.colmap = arguments.colmap.string(),
                          .model = arguments.model,
                          .found = found,
                          .options = arguments.colmap_run,
                          .threads = arguments.console.threads},
                         scratch, log);
}

/// The names of the columns: file names, or full paths if file names are equal.
std::vector<std::string> column_names(const std::vector<fs::path>& meshes)
{
    std::vector<std::string> names;
    for (const fs::path& mesh : meshes) {
        const auto same = std::ranges::count(meshes, mesh.filename(), &fs::path::filename);
        names.push_back(same == 1 ? mesh.filename().string() : mesh.string());
    }
    return names;
}

Reference reference_of(const CompareArguments& arguments, Scene model, Log& log)
{
    NamedMesh truth;
    if (!arguments.truth.empty()) truth = {arguments.truth.string(), read_ply(arguments.truth)};
    return complete_reference(std::move(model), arguments.truth.empty() ? nullptr : &truth,
                              arguments.measure, log);
}

/// The reference of the measurements, and the outputs that show the meshes.
struct Yardstick {
    const Reference& reference;
    PreviewOutput& preview;
    CompareReport& report;
    Log& log;
};

/// Measures a mesh as the column with this name. Errors give the mesh's own name.
Comparison measure(const NamedMesh& mesh, const std::string& column, const Yardstick& by)
{
    Comparison comparison = compare_mesh(mesh, by.reference, by.log);
    comparison.name = column;
    by.preview.add(column, mesh.mesh, {}, by.log);
    by.report.add(column, mesh.mesh);
    return comparison;
}

/// Measures the baselines, one column each.
std::vector<Comparison> measure_baselines(std::vector<BaselineMesh> baselines, const Yardstick& by)
{
    std::vector<Comparison> columns;
    for (BaselineMesh& baseline : baselines) {
        Comparison column;
        column.name = baseline.name;
        if (baseline.failure.empty()) {
            column = measure({baseline.name, std::move(baseline.mesh)}, baseline.name, by);
        }
        column.failure = baseline.failure;
        column.cost = baseline.cost;
        columns.push_back(std::move(column));
    }
    return columns;
}

/// Measures the mesh files, one column each.
std::vector<Comparison> measure_files(const CompareArguments& arguments, const Yardstick& by)
{
    std::vector<Comparison> columns;
    const std::vector<std::string> names = column_names(arguments.meshes);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const fs::path& path = arguments.meshes[i];
        columns.push_back(measure({path.string(), read_ply(path)}, names[i], by));
    }
    return columns;
}

} // namespace

Manual compare_manual()
{
    Manual manual;
    manual.command = "colmap-vcarve compare";
    manual.operands = "MODEL A.ply [B.ply ...]";
    manual.summary = "Measure meshes against their model, and against the true surface.";
    manual.examples = {
        {"colmap-vcarve compare sparse/0 a.ply b.ply", "which fits better"},
        {"colmap-vcarve compare sparse/0 a.ply --truth gt.ply", "accuracy"},
        {"colmap-vcarve compare sparse/0 --colmap colmap", "against COLMAP"},
        {"colmap-vcarve compare sparse/0 a.ply --preview a.png", "a picture"},
        {"colmap-vcarve compare sparse/0 a.ply --report a.html", "a web page"},
    };
    manual.operand_meanings = {
        {"MODEL", "The model of the meshes, as for colmap-vcarve."},
        {"A.ply ...", "Meshes in the model's frame, one column each. Optional with --colmap."},
    };
    manual.ends = {"The table explains its figures.", kExitCodes};
    const auto arguments = std::make_shared<CompareArguments>();
    manual.options = options_of(*arguments);
    manual.values = arguments;
    return manual;
}

void run_compare(const ParsedArguments& given)
{
    const CompareArguments arguments = read_arguments(given);
    limit_threads(arguments.console.threads);
    ConsoleLog log(console_on_stderr(arguments.console.quiet, arguments.console.verbose));
    const RunInput input = checked_input(arguments, log);

    std::vector<BaselineMesh> baselines = baselines_of(arguments, input.found, log);
    remove_on_signals(arguments, nullptr);
    if (baselines.empty() && arguments.meshes.empty()) {
        throw InputError(fmt::format("found nothing to compare: neither program made a mesh of {}",
                                     arguments.model.path.string()));
    }
    ReadModel model = read_found_model(input.found, log);
    PreviewOutput preview(arguments.outputs.preview);
    preview.set_scene(model.scene);
    CompareReport report(arguments.outputs.report);
    report.set_scene(model.scene);
    const Reference reference = reference_of(arguments, std::move(model.scene), log);
    const Yardstick by{reference, preview, report, log};
    std::vector<Comparison> comparisons = measure_baselines(std::move(baselines), by);
    std::ranges::move(measure_files(arguments, by), std::back_inserter(comparisons));
    preview.write();
    report.write(comparisons, reference, arguments.command, log);
    print(comparison_table(comparisons, reference));
    if (arguments.outputs.json.empty()) return;
    OutputFile file(arguments.outputs.json);
    file.stream() << comparison_json(comparisons, reference);
    file.commit();
}

} // namespace vcarve::cli
