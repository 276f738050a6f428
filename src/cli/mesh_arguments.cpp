#include "cli/mesh_arguments.h"

#include "cli/run_record.h"
#include "io/formats/mesh_file.h"
#include "io/formats/textured_files.h"
#include "options/declared.h"
#include "page/page.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <memory>
#include <system_error>

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

OptionList work_options(MeshArguments& arguments)
{
    return {
        {kRunStage,
         {.name = "work",
          .unit = "folder",
          .help = "Where to keep what every stage made, and what does not fit into memory, until "
                  "the surface is written: the same command, given again after it was killed or "
                  "found the disk full, goes on after the last stage that was finished."},
         &arguments.work},
        {kRunStage,
         {.name = "keep-work",
          .help = "Leave the folder of --work as it is at the end, instead of removing what the "
                  "run put there.",
          .tuning = true},
         &arguments.keeps_work},
    };
}

OptionList record_options(MeshArguments& arguments)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "stats",
          .help = "Write options, counts, seconds and peak memory of every stage, and a check of "
                  "the mesh, as JSON."},
         &arguments.stats},
        {kStage,
         {.name = "report",
          .help = "Write a page for browsers, OUT.html, that needs no network: the surface in 3D "
                  "with cameras, points and the faces that were taken away, what every stage "
                  "took, what the filter dropped and why, and what to be wary of."},
         &arguments.report},
        {kStage,
         {.name = "check",
          .help =
              "Check the surface before it is written, as --stats and --report do, too: that it "
              "is manifold and oriented and has no degenerate face. Edges where it ends, faces "
              "that go through others and rays that meet it from behind are counted.",
          .tuning = true},
         &arguments.checks},
        {kStage,
         {.name = "replay",
          .unit = "file",
          .help = "Print the command that made this surface, as its file tells (.ply, .obj, .off "
                  "or .glb), and do nothing else.",
          .tuning = true},
         &arguments.replay},
    };
}

void check_output(const fs::path& out, const OutputOptions& options)
{
    // What is a folder is refused as such later.
    std::error_code error;
    if (!out.has_filename() || fs::is_directory(out, error)) return;
    require_mesh_name(out);
    if (options.ascii) require_ply(out, "--ascii");
    if (options.attributes) require_ply(out, "--attributes");
}

} // namespace

OptionList options_of(OutputOptions& output)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "ascii",
          .help = "Write numbers as text instead of binary; PLY only.",
          .tuning = true},
         &output.ascii},
        {kStage,
         {.name = "attributes",
          .help = "Write what vertices and faces come from: point3d_id, num_views and error_px of "
                  "each vertex, support of each face; PLY only."},
         &output.attributes},
        {kStage,
         {.name = "offset",
          .help = "What is subtracted from the coordinates that are written, and said in the "
                  "file; auto: round numbers for a model far from the origin, as in UTM, so that "
                  "programs that compute with floats lose nothing.",
          .min = -kUnlimited,
          .words = {"none", "auto"}},
         &output.offset},
        {kStage,
         {.name = "transform",
          .unit = "file or scale",
          .help = "What is done to the coordinates that are written, before --offset, and said in "
                  "the file: a number scales them; a file moves them to another frame, as COLMAP's "
                  "model_aligner writes it (scale, quaternion, translation) or as a matrix of 3 or "
                  "4 rows."},
         &output.transform},
        {kStage,
         {.name = "up",
          .help = "What points up in .glb, whose y is up: auto, what is above for most cameras; z, "
                  "of what is written; none, y as it is. It is said in the file.",
          .words = {"auto", "z", "none"},
          .tuning = true},
         value_of_enum(output.up)},
        {kStage, {.name = "quiet", .help = "Print nothing but errors."}, &output.quiet},
        {kStage,
         {.name = "verbose", .help = "Print every stage and all that it counted."},
         &output.verbose},
    };
}

OptionList options_of(MeshArguments& arguments)
{
    return joined({options_of(arguments.model), options_of(arguments.options),
                   work_options(arguments), options_of(arguments.output),
                   texture_options(arguments.texture), preview_options(arguments.preview),
                   record_options(arguments), options_of(arguments.help)});
}

std::vector<Output> outputs_of(const MeshArguments& arguments)
{
    constexpr std::size_t kManyPages = 64;
    std::vector<Output> outputs = {{"the surface", arguments.out}};
    if (arguments.texture.texture) {
        for (const fs::path& file : files_beside(arguments.out, kManyPages)) {
            outputs.push_back({"the texture", file});
        }
    }
    if (!arguments.preview.out.empty()) outputs.push_back({"--preview", arguments.preview.out});
    if (!arguments.stats.empty()) outputs.push_back({"--stats", arguments.stats});
    if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
    return outputs;
}

MeshArguments read_mesh_arguments(const ParsedArguments& given)
{
    MeshArguments arguments;
    read_options(given, options_of(arguments));
    check_operands(given.operands);
    arguments.model.path = given.operands[0];
    arguments.out = given.operands[1];
    check_output(arguments.out, arguments.output);
    check_texture(arguments.texture, arguments.out, given);
    check_preview(arguments.preview, given);
    if (!arguments.report.empty()) require_page_name(arguments.report);
    if (arguments.keeps_work && arguments.work.empty()) {
        throw UsageError(fmt::format("--keep-work keeps the folder of --work, which was not "
                                     "given{}",
                                     kSeeHelp));
    }
    arguments.command = command_text("colmap-vcarve", given.typed);
    require_distinct(outputs_of(arguments));
    return arguments;
}

Manual mesh_manual()
{
    Manual manual;
    manual.command = "colmap-vcarve";
    manual.operands = "MODEL OUT.ply";
    manual.summary = "Turns a COLMAP model into a surface.";
    manual.examples = {
        {"colmap-vcarve sparse/0 mesh.ply", "any sparse model"},
        {"colmap-vcarve dense mesh.ply", "stereo_fusion's points"},
        {"colmap-vcarve scan.ply mesh.ply", "a laser scan"},
        {"colmap-vcarve sparse/0 mesh.ply --report run.html", "and a page to look at it"},
        {"colmap-vcarve sparse/0 mesh.ply --preview mesh.png", "and a picture of it"},
        {"colmap-vcarve sparse/0 mesh.glb", "for browsers and engines"},
        {"colmap-vcarve sparse/0 mesh.glb --texture", "with the photographs"},
        {"colmap-vcarve --closed sparse/0 mesh.ply", "watertight"},
        {"colmap-vcarve --crop auto sparse/0 mesh.ply", "what was looked at only"},
    };
    manual.operand_meanings = {
        {"MODEL",
         "A folder with cameras, images and points3D (.bin or .txt), a folder of such "
         "models, or a workspace that holds sparse/0 or sparse; with fused.ply and "
         "fused.ply.vis, as stereo_fusion leaves them, the dense points are taken. Or a PLY file: "
         "of a dense workspace, or of a laser scan with the places of its scanners. Or a "
         "transforms.json of nerfstudio, with its points."},
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
         "One line a stage on stderr, and at the end how much of what cameras see is open (lines "
         "of sight through all images that meet no face where the closed surface has one) and "
         "what to try. On terminals a bar of the whole run, if that takes over 5 seconds."},
        {"Exit code", "0 done, 1 internal error, 2 wrong usage or output, 3 wrong input."},
    };
    const auto arguments = std::make_shared<MeshArguments>();
    manual.options = options_of(*arguments);
    manual.values = arguments;
    return manual;
}

} // namespace vcarve::cli
