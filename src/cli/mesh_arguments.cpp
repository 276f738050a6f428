#include "cli/mesh_arguments.h"

#include "base/text.h"
#include "cli/run_record.h"
#include "io/dense/visibility.h"
#include "io/formats/mesh_file.h"
#include "io/formats/textured_files.h"
#include "options/declared.h"
#include "page/page.h"
#include "pipeline/scene_run.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <system_error>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// Throws UsageError with the superfluous operand.
void refuse_stray(const ParsedArguments& given)
{
    const std::vector<std::string>& operands = given.operands;
    const auto out =
        std::ranges::find_if(operands.begin() + 1, operands.end(),
                             [](const std::string& word) { return is_mesh_name(word); });
    if (operands.size() == 3 && !given.named_output.empty() && out != operands.end() - 1) {
        throw UsageError(fmt::format("the output is given twice, {} and -o {}; remove one", *out,
                                     given.named_output));
    }
    const auto command = std::ranges::find_if(
        operands, [](const std::string& word) { return word.ends_with("_mesher"); });
    if (command != operands.end()) {
        throw UsageError(fmt::format("{} is a command of COLMAP; type colmap-vcarve MODEL OUT.ply "
                                     "without it",
                                     *command));
    }
    const std::string& stray = operands[out == operands.begin() + 1 ? 2 : 1];
    throw UsageError(fmt::format("unexpected argument \"{}\"; quote paths that contain blanks{}",
                                 stray, kSeeHelp));
}

void check_operands(const ParsedArguments& given)
{
    const std::vector<std::string>& operands = given.operands;
    if (operands.empty()) throw UsageError(fmt::format("missing MODEL and OUT.ply{}", kSeeHelp));
    if (operands.size() == 1) {
        const bool is_output = !given.named_output.empty();
        throw UsageError(fmt::format("missing {} {}{}",
                                     is_output ? "MODEL before" : "OUT.ply after", operands[0],
                                     kSeeHelp));
    }
    if (operands.size() > 2) refuse_stray(given);
    if (is_mesh_name(operands[0]) && !is_mesh_name(operands[1])) {
        throw UsageError(fmt::format("the model comes first and the output second: colmap-vcarve "
                                     "{} {}",
                                     operands[1], operands[0]));
    }
}

OptionList work_options(MeshArguments& arguments)
{
    return {
        {kRunStage,
         {.name = "work",
          .unit = "folder",
          .help =
              "Keep finished tiles and depth maps in FOLDER. The same command, run again after it "
              "was killed or the disk was full, resumes after these. With --tile-points, several "
              "processes with the same command share the tiles, on one or more machines."},
         &arguments.work},
        {kRunStage,
         {.name = "keep-work",
          .help = "Keep the files of --work at the end.",
          .level = OptionLevel::advanced},
         &arguments.keeps_work},
        {kRunStage,
         {.name = "tile-points",
          .unit = "points",
          .help = "Divide the model into tiles of at most N points, and join their surfaces. Needs "
                  "the memory of a tile and of the mesh. 0: only if --max-memory requires tiles.",
          .level = OptionLevel::advanced},
         &arguments.tile_points},
    };
}

OptionList record_options(MeshArguments& arguments)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "keep-points",
          .unit = "file",
          .help = "Write the dense points to FILE.ply and their views to FILE.ply.vis, as COLMAP's "
                  "stereo_fusion does.",
          .level = OptionLevel::advanced},
         &arguments.keep_points},
        {kStage,
         {.name = "stats",
          .help = "Write options, counts, seconds and peak memory of every stage, and a check of "
                  "the mesh, as JSON.",
          .level = OptionLevel::advanced},
         &arguments.stats},
        {kStage,
         {.name = "report",
          .help = "Write a web page with the mesh, OUT.html. It shows the mesh in 3D with cameras, "
                  "points and removed faces, and the costs of stages, dropped points and warnings. "
                  "It needs no network."},
         &arguments.report},
        {kStage,
         {.name = "check",
          .help = "Check that the mesh is manifold and oriented and has no degenerate face, as "
                  "--stats and --report do. Boundary edges, self-intersections and rays from "
                  "behind are counted.",
          .level = OptionLevel::advanced},
         &arguments.checks},
    };
}

/// Throws UsageError if an option needs --dense or --texture, or contradicts it.
void check_photo_options(const MeshArguments& arguments, const ParsedArguments& given)
{
    const bool is_dense = arguments.options.dense.dense;
    for (const char* const name : {"dense-size", "refine-size", "keep-points"}) {
        if (given.has(name) && !is_dense) {
            throw UsageError(fmt::format("--{} needs --dense", name));
        }
    }
    if (is_dense && given.has("points")) {
        throw UsageError("--dense and --points both supply dense points; remove one of them");
    }
    const fs::path& points = arguments.keep_points;
    if (!points.empty() && lower_case_end(points) != ".ply") {
        throw UsageError(fmt::format("cannot write {}: --keep-points needs .ply", points.string()));
    }
    if (given.has("texture-scale") && !arguments.options.texture.texture) {
        throw UsageError("--texture-scale needs --texture");
    }
    if (arguments.options.texture.texture) require_texture_name(arguments.out);
}

void check_output(const fs::path& out, const OutputOptions& options)
{
    // Folders are rejected later, with another message.
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
    using enum OptionLevel;
    return {
        {kStage,
         {.name = "ascii",
          .help = "Write text instead of binary numbers; PLY only.",
          .level = advanced},
         &output.ascii},
        {kStage,
         {.name = "attributes",
          .help = "Write point3d_id, num_views and error_px of each vertex and support of each "
                  "face; PLY only.",
          .level = advanced},
         &output.attributes},
        {kStage,
         {.name = "offset",
          .help = "Subtract this from coordinates. The file header records it. auto: round numbers "
                  "for a model far from the origin, as in UTM, so that float32 is exact enough.",
          .min = -kUnlimited,
          .words = {"none", "auto"}},
         &output.offset},
        {kStage,
         {.name = "transform",
          .unit = "file or scale",
          .help = "Transform coordinates before --offset, and record it in the file header. A "
                  "number is a scale. A file has a transformation as COLMAP's model_aligner writes "
                  "it (scale, quaternion, translation), a matrix of 3 or 4 rows, or nerfstudio's "
                  "dataparser_transforms.json.",
          .level = advanced},
         &output.transform},
        up_option(output.up),
        {kStage,
         {.name = "upright",
          .help = "Rotate coordinates after --transform so that the direction of --up becomes z, "
                  "and record it in the file header.",
          .level = advanced},
         &output.upright},
        {kStage, {.name = "quiet", .help = "Print only errors."}, &output.quiet},
        {kStage,
         {.name = "verbose", .help = "Print every stage with all its counts.", .level = advanced},
         &output.verbose},
    };
}

OptionList options_of(MeshArguments& arguments)
{
    return joined({options_of(arguments.model), options_of(arguments.options),
                   work_options(arguments), options_of(arguments.output),
                   preview_options(arguments.preview), record_options(arguments),
                   options_of(arguments.help)});
}

std::vector<Output> outputs_of(const MeshArguments& arguments)
{
    std::vector<Output> outputs = {{"the mesh", arguments.out}};
    if (arguments.options.texture.texture) {
        std::ranges::move(texture_outputs(arguments.out), std::back_inserter(outputs));
    }
    if (!arguments.keep_points.empty()) {
        outputs.push_back({"--keep-points", arguments.keep_points});
        outputs.push_back({"--keep-points", visibility_beside(arguments.keep_points)});
    }
    if (!arguments.preview.out.empty()) outputs.push_back({"--preview", arguments.preview.out});
    if (!arguments.stats.empty()) outputs.push_back({"--stats", arguments.stats});
    if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
    return outputs;
}

const char* option_of_one_piece(const MeshArguments& arguments)
{
    const Options& options = arguments.options;
    const std::pair<bool, const char*> whole[] = {
        {options.crop.region.kind != RegionChoice::Kind::everything, "--crop"},
        {options.labels.virtual_views.count > 0, "--virtual-views"},
        {options.surface.closed, "--closed"},
        {options.refine.smooth.iterations > 0, "--smooth"},
        {options.refine.simplify.faces > 0, "--simplify"},
        {options.texture.texture, "--texture"},
        {!options.images.empty() && !options.dense.dense, "--images"},
        {!options.masks.folder.empty(), "--masks"},
        {arguments.output.attributes, "--attributes"},
        {!arguments.report.empty(), "--report"}};
    const auto given = std::ranges::find_if(whole, [](const auto& each) { return each.first; });
    return given == std::end(whole) ? nullptr : given->second;
}

MeshArguments read_mesh_arguments(const ParsedArguments& given)
{
    MeshArguments arguments;
    read_options(given, options_of(arguments));
    check_operands(given);
    arguments.model.path = given.operands[0];
    arguments.out = given.operands[1];
    check_output(arguments.out, arguments.output);
    if (arguments.output.upright && arguments.output.up.word == static_cast<int>(UpWord::none))
        throw UsageError("--upright needs an up direction, but --up is none");
    check_photo_options(arguments, given);
    if (arguments.options.dense.dense) arguments.model.points.points = "sparse";
    arguments.options = resolved(arguments.options);
    check_preview(arguments.preview, given);
    if (const char* const name = option_of_one_piece(arguments);
        name != nullptr && arguments.tile_points > 0) {
        throw UsageError(fmt::format("{} needs the model in one piece, not in tiles; leave out "
                                     "one of the options",
                                     name));
    }
    if (!arguments.report.empty()) require_page_name(arguments.report);
    if (arguments.keeps_work && arguments.work.empty()) {
        throw UsageError("--keep-work needs --work FOLDER");
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
    manual.summary = "Turn a COLMAP model, dense cloud or laser scan into a triangle mesh.";
    manual.examples = {
        {"colmap-vcarve sparse/0 mesh.ply", "a sparse model"},
        {"colmap-vcarve dense mesh.ply", "a dense workspace"},
        {"colmap-vcarve scan.ply mesh.ply", "a laser scan"},
        {"colmap-vcarve sparse/0 mesh.glb --texture", "with a texture"},
        {"colmap-vcarve sparse/0 mesh.ply --report mesh.html", "and a web page"},
    };
    manual.operand_meanings = {
        {"MODEL",
         "A COLMAP model, workspace, PLY or transforms.json. A model is a folder with cameras, "
         "images and points3D (.bin or .txt). A workspace holds sparse/0 or sparse; its dense "
         "points are used if fused.ply and fused.ply.vis exist. A PLY file is the cloud of a dense "
         "workspace, or a laser scan with scanner positions. transforms.json is nerfstudio's, with "
         "its points."},
        {"OUT.ply",
         "The mesh: .ply, .obj, .off, .stl or .glb. The file extension selects the format. It is "
         "in the model's frame, with vertex colors (not .stl) and normals (not .off or .stl)."},
    };
    manual.ends = {
        "Measure meshes: colmap-vcarve compare --help. Texture any mesh: texture --help.",
        "All options: --help-all.", kExitCodes};
    const auto arguments = std::make_shared<MeshArguments>();
    manual.options = options_of(*arguments);
    manual.values = arguments;
    return manual;
}

} // namespace vcarve::cli
