#include "cli/mesh_arguments.h"

#include "cli/run_record.h"
#include "io/formats/mesh_file.h"
#include "page/page.h"
#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

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

/// Under the heading "Run", which is the last of Options.
void list_work_options(OptionTable& table)
{
    bool off = false;
    table.path({.name = "work",
                .unit = "folder",
                .help = "Where the files of --blocks go, on a disk with room for them, and what "
                        "every stage made, until the surface is written: the same command, given "
                        "again, goes on after the last stage that a run finished which was killed "
                        "or found the disk full. It is made where there is none. By default only "
                        "the files of --blocks, in a folder beside the output."});
    table.flag(off, {.name = "keep-work",
                     .help = "Leave the folder of --work as it is at the end, instead of "
                             "removing what the run put there."});
}

void read_work_options(const ParsedArguments& given, MeshArguments& arguments)
{
    if (given.has("work")) arguments.work = given.options.at("work");
    arguments.keeps_work = given.has("keep-work");
    if (given.has("work") && arguments.work.empty()) {
        throw UsageError(fmt::format("--work takes a folder, but got an empty path{}", kSeeHelp));
    }
    if (arguments.keeps_work && arguments.work.empty()) {
        throw UsageError(fmt::format("--keep-work keeps the folder of --work, which was not "
                                     "given{}",
                                     kSeeHelp));
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

} // namespace

std::vector<OptionRow> mesh_options()
{
    Options options;
    OutputOptions output;
    bool off = false;
    OptionTable table;
    list_points_options(table);
    options.visit(table);
    list_work_options(table);
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

std::vector<Output> outputs_of(const MeshArguments& arguments)
{
    std::vector<Output> outputs = {{"the surface", arguments.out}};
    if (!arguments.preview.out.empty()) outputs.push_back({"--preview", arguments.preview.out});
    if (arguments.with_stats) outputs.push_back({"--stats", arguments.stats});
    if (arguments.with_report) outputs.push_back({"--report", arguments.report});
    return outputs;
}

MeshArguments read_mesh_arguments(const ParsedArguments& given)
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
    read_work_options(given, arguments);
    arguments.command = command_text("colmap-vcarve", given.typed);
    require_distinct(outputs_of(arguments));
    return arguments;
}

} // namespace vcarve::cli
