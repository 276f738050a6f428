#include "base/stage_counts.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/console_log.h"
#include "cli/exit_code.h"
#include "cli/input_output.h"
#include "cli/mesh_report.h"
#include "cli/picture_output.h"
#include "io/formats/mesh_file.h"
#include "io/formats/mesh_reader.h"
#include "io/input/read_model.h"
#include "model/views.h"
#include "picture/eye.h"
#include "pipeline/scene_run.h"
#include "tiles/run_memory.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

enum class Task { texture, refine };

/// The parsed command line.
struct PhotoCommand {
    Task task = Task::texture;
    ModelArguments model;
    fs::path mesh;
    fs::path out;
    Options options;
    PreviewArguments preview;
    ConsoleArguments console;
    HelpOptions help;

    const char* name() const { return task == Task::texture ? "texture" : "refine"; }

    std::vector<Output> outputs() const
    {
        std::vector<Output> all = {
            {task == Task::texture ? "the textured mesh" : "the refined mesh", out}};
        if (task == Task::texture) std::ranges::move(texture_outputs(out), std::back_inserter(all));
        if (!preview.out.empty()) all.push_back({"--preview", preview.out});
        return all;
    }
};

OptionList options_of(PhotoCommand& command)
{
    const bool textures = command.task == Task::texture;
    OptionList photographs = vcarve::options_of(command.options);
    std::erase_if(photographs, [&](const Option& option) {
        const std::string& name = option.info.name;
        return name != "images" && name != "masks" &&
               name != (textures ? "texture-scale" : "refine-size");
    });
    for (Option& option : photographs) {
        std::string& help = option.info.help;
        if (option.info.name == "images") {
            help = "Use the photographs in FOLDER, not in `images` beside the model.";
        } else if (option.info.name == "masks") {
            help = "Exclude the black pixels of FOLDER/NAME.png from photograph NAME, as COLMAP "
                   "does. They give no colors and move no vertices. No faces are removed.";
        } else if (option.info.name == "refine-size") {
            help = "Scale the longest side of photographs to N pixels. Time grows with the square "
                   "of N.";
            option.info.min = 100;
        }
    }
    return joined({photographs, preview_options(command.preview),
                   cli::options_of(command.console, "Print only errors."),
                   cli::options_of(command.help)});
}

PhotoCommand read_command(Task task, const ParsedArguments& given)
{
    PhotoCommand command;
    command.task = task;
    read_options(given, options_of(command));
    if (given.operands.size() != 3)
        throw UsageError(fmt::format("expected MODEL MESH {}, found {} arguments (see "
                                     "colmap-vcarve {} --help)",
                                     task == Task::texture ? "OUT.glb" : "OUT.ply",
                                     given.operands.size(), command.name()));
    command.model.path = given.operands[0];
    command.model.points.points = "sparse";
    command.mesh = given.operands[1];
    command.out = given.operands[2];
    require_readable_mesh_name(command.mesh);
    require_mesh_name(command.out);
    if (task == Task::texture) require_texture_name(command.out);
    command.options.texture.texture = task == Task::texture;
    command.options.dense.dense = task == Task::refine;
    command.options.threads = command.console.threads;
    command.options.memory.limit = allowed_memory(command.options.memory).value_or(0);
    check_preview(command.preview, given);
    require_distinct(command.outputs());
    return command;
}

Manual manual_of(Task task)
{
    const auto command = std::make_shared<PhotoCommand>();
    command->task = task;
    Manual manual;
    manual.command = fmt::format("colmap-vcarve {}", command->name());
    manual.ends = {kExitCodes};
    manual.options = options_of(*command);
    manual.values = command;
    manual.operand_meanings = {
        {"MODEL", "The model of the photographs, as for colmap-vcarve."},
        {"MESH",
         "A mesh in the model's frame: .ply, .obj, .off or .stl. It need not be manifold."}};
    return manual;
}

/// Reads the inputs, calls make(scene, mesh, run) and writes what it returns.
template <typename Make>
void run_command(const PhotoCommand& command, ConsoleLog& log, const Make& make)
{
    prepare_outputs(command.outputs());
    const RunInput input = resolve_input(command.model.path, command.model.all_points(),
                                         command.options, needs_view(command.preview), log);
    keep_inputs(command.outputs(), input, {{"the mesh", command.mesh}});
    if (needs_view(command.preview)) named_view(input.views, command.preview.view);
    TriMesh mesh = read_mesh(command.mesh);
    const Scene scene = read_found_model(input.found, log).scene;
    PreviewOutput preview(command.preview);
    preview.set_scene(scene);
    const TexturedMesh made = make(scene, std::move(mesh), {command.options, input.images, log});
    {
        Stage stage(log, "write");
        write_mesh(command.out, made.mesh,
                   {.comments = {"made by colmap-vcarve " + versions().program},
                    .texture = made.texture.is_empty() ? nullptr : &made.texture,
                    .up = made.up});
        stage.end({{counts::kOutput.faces, size_of(made.mesh.faces.size())},
                   {counts::kOutput.vertices, size_of(made.mesh.positions.size())}});
    }
    preview.add(command.out.filename().string(), made.mesh, made.texture, log);
    preview.write();
    const std::string faces = grouped_digits(size_of(made.mesh.faces.size()));
    if (command.task == Task::refine) {
        return log.conclude(fmt::format("wrote {}: {} faces", command.out.string(), faces));
    }
    log.conclude(fmt::format("wrote {}: {} faces, {} of them shown by no photograph",
                             command.out.string(), faces,
                             grouped_digits(bare_faces(log.counts()))));
}

} // namespace

Manual texture_manual()
{
    Manual manual = manual_of(Task::texture);
    manual.operands = "MODEL MESH OUT.glb";
    manual.summary = "Texture any mesh with the photographs of a model.";
    manual.examples = {
        {"colmap-vcarve texture sparse/0 edited.ply out.glb", "an edited mesh"},
        {"colmap-vcarve texture sparse/0 a.ply out.obj --images photos", "from a folder"},
    };
    manual.operand_meanings.push_back(
        {"OUT.glb", "The textured mesh: .glb, .obj or .ply. Faces that no photograph shows "
                    "completely may be bisected, which does not change the shape."});
    return manual;
}

Manual refine_manual()
{
    Manual manual = manual_of(Task::refine);
    manual.operands = "MODEL MESH OUT.ply";
    manual.summary = "Make any mesh as sharp as the photographs of a model.";
    manual.examples = {
        {"colmap-vcarve refine sparse/0 poisson.ply out.ply", "a mesh of another program"},
        {"colmap-vcarve refine sparse/0 a.ply out.ply --images photos", "from a folder"},
    };
    manual.operand_meanings.push_back(
        {"OUT.ply", "The refined mesh: .ply, .obj, .glb, .off or .stl, with the photographs' "
                    "colors. Small faces are where the surface is detailed."});
    return manual;
}

void run_texture(const ParsedArguments& given)
{
    const PhotoCommand command = read_command(Task::texture, given);
    limit_threads(command.console.threads);
    ConsoleLog log(console_on_stderr(command.console.quiet, command.console.verbose));
    run_command(command, log, [](const Scene& scene, TriMesh mesh, const SceneRun& run) {
        return texture_mesh(scene, std::move(mesh), run);
    });
}

void run_refine(const ParsedArguments& given)
{
    const PhotoCommand command = read_command(Task::refine, given);
    limit_threads(command.console.threads);
    ConsoleLog log(console_on_stderr(command.console.quiet, command.console.verbose));
    run_command(command, log, [](const Scene& scene, TriMesh mesh, const SceneRun& run) {
        return TexturedMesh{refined_mesh(scene, std::move(mesh), run), {}, up_of(scene)};
    });
}

} // namespace vcarve::cli
