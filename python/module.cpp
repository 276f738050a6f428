// The compiled part of `import vcarve`: its classes, and runs with a listener. Users call the
// functions in vcarve/__init__.py, which has the keywords.
#include "arguments.h"
#include "arrays.h"
#include "base/version.h"
#include "io/formats/output_frame.h"
#include "logged_run.h"
#include "mesh_class.h"
#include "options/declared.h"
#include "run/job.h"
#include "scene_class.h"
#include "steps/6_surface/provenance.h"
#include "vcarve/compare.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <utility>
#include <variant>

namespace vcarve::python {

namespace {

namespace fs = std::filesystem;

/// What reconstruct() needs besides the input.
struct RunKeywords {
    Options options;
    bool attributes = false;
    WordOrVector up;
};

RunKeywords run_keywords(const py::dict& keywords, const py::dict& output, bool attributes)
{
    RunKeywords run;
    run.attributes = attributes;
    set_options(options_of(run.options), keywords);
    set_options({up_option(run.up)}, output);
    return run;
}

std::shared_ptr<Mesh> mesh_of(Reconstruction made, const RunKeywords& run)
{
    auto mesh = std::make_shared<Mesh>();
    if (run.attributes) mesh->provenance = find_provenance(made.mesh, made.scene);
    mesh->up = up_for(made.scene, run.up, std::nullopt);
    mesh->texture = std::move(made.texture);
    mesh->comments = std::move(made.comments);
    // as the program lists options of the output
    if (run.attributes) mesh->comments.emplace_back("option attributes");
    WordOrVector usual;
    WordOrVector up = run.up;
    for (std::string& changed : changed_options({up_option(up)}, {up_option(usual)})) {
        mesh->comments.push_back(std::move(changed));
    }
    mesh->run_positions = made.mesh.positions;
    mesh->run_offset = made.mesh.offset;
    mesh->surface = in_frame_of_model(std::move(made.mesh));
    return mesh;
}

PointsOptions points_of(const py::dict& keywords)
{
    PointsArguments arguments;
    set_options(options_of(arguments), keywords);
    return arguments.all_points();
}

template <typename AnyOptions>
AnyOptions options_from(const py::dict& keywords)
{
    AnyOptions options;
    set_options(options_of(options), keywords);
    return options;
}

std::shared_ptr<Mesh> reconstruct_scene(const std::shared_ptr<Scene>& scene,
                                        const py::dict& keywords, const py::dict& output,
                                        bool attributes, const py::object& listener)
{
    const RunKeywords run = run_keywords(keywords, output, attributes);
    std::optional<Reconstruction> made;
    run_told(listener, [&](Log& log) { made = reconstruct(Scene(*scene), run.options, log); });
    return mesh_of(std::move(*made), run);
}

/// Moves the arrays of the scene instead of copying them; the scene is empty afterwards.
std::shared_ptr<Mesh> consume_scene(const std::shared_ptr<Scene>& scene, const py::dict& keywords,
                                    const py::dict& output, bool attributes,
                                    const py::object& listener)
{
    const RunKeywords run = run_keywords(keywords, output, attributes);
    require_unseen(scene);
    std::optional<Reconstruction> made;
    run_told(listener, [&](Log& log) {
        made = reconstruct(std::exchange(*scene, Scene()), run.options, log);
    });
    return mesh_of(std::move(*made), run);
}

std::shared_ptr<Mesh> reconstruct_model(const fs::path& model, const py::dict& input,
                                        const py::dict& keywords, const py::dict& output,
                                        bool attributes, const py::object& listener)
{
    const PointsOptions points = points_of(input);
    const RunKeywords run = run_keywords(keywords, output, attributes);
    std::optional<Reconstruction> made;
    run_told(listener, [&](Log& log) { made = reconstruct(model, points, run.options, log); });
    return mesh_of(std::move(*made), run);
}

std::shared_ptr<Scene> read_scene(const fs::path& model, const py::dict& input,
                                  const py::object& listener)
{
    const PointsOptions points = points_of(input);
    auto scene = std::make_shared<Scene>();
    run_told(listener, [&](Log& log) { *scene = read_model(model, points, log); });
    return scene;
}

/// Textures a mesh with the photographs of a model, the path or a scene.
std::shared_ptr<Mesh> texture_mesh(const std::variant<std::shared_ptr<Scene>, fs::path>& model,
                                   const std::shared_ptr<Mesh>& mesh, const py::dict& keywords,
                                   const py::object& listener)
{
    const auto options = options_from<Options>(keywords);
    require_corners(mesh->surface);
    auto made = std::make_shared<Mesh>();
    TexturedMesh textured;
    run_told(listener, [&](Log& log) {
        const auto* const path = std::get_if<fs::path>(&model);
        textured = path == nullptr ? texture(*std::get<0>(model), mesh->surface, options, log)
                                   : texture(*path, mesh->surface, options, log);
    });
    made->surface = std::move(textured.mesh);
    made->texture = std::move(textured.texture);
    made->up = textured.up;
    return made;
}

using NamedShared = std::pair<std::string, std::shared_ptr<Mesh>>;

/// Compares meshes. Returns JSON text.
std::string compare_meshes(const std::shared_ptr<Scene>& model,
                           const std::vector<NamedShared>& meshes,
                           const std::optional<NamedShared>& truth, const py::dict& keywords,
                           const py::object& listener)
{
    const auto options = options_from<CompareOptions>(keywords);
    std::vector<NamedMesh> named;
    for (const auto& [name, mesh] : meshes) {
        require_corners(mesh->surface);
        named.push_back({name, mesh->surface});
    }
    std::optional<NamedMesh> true_mesh;
    if (truth) require_corners(truth->second->surface);
    if (truth) true_mesh = {truth->first, truth->second->surface};
    std::string json;
    run_told(listener, [&](Log& log) {
        json = compare(*model, named, true_mesh ? &*true_mesh : nullptr, options, log).json;
    });
    return json;
}

py::dict declared_options()
{
    PointsArguments points;
    Options options;
    CompareOptions compare;
    py::dict all;
    all["input"] = describe(options_of(points));
    all["reconstruct"] = describe(options_of(options));
    OptionList for_texture = options_of(options);
    std::erase_if(for_texture, [](const Option& option) {
        const std::string& name = option.info.name;
        return name != "images" && name != "masks" && name != "texture-scale" &&
               option.stage != kRunStage;
    });
    all["texture"] = describe(for_texture);
    WordOrVector up;
    all["output"] = describe({up_option(up)});
    all["compare"] = describe(options_of(compare));
    return all;
}

void add_errors(py::module_& module)
{
    const auto value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
    const auto& base = py::register_exception<Error>(module, "Error", PyExc_Exception);
    const py::tuple bases = py::make_tuple(base, value_error);
    py::register_exception<UsageError>(module, "UsageError", bases);
    py::register_exception<InputError>(module, "InputError", bases);
}

} // namespace

PYBIND11_MODULE(_vcarve, module)
{
    module.attr("__version__") = versions().program;
    add_errors(module);
    add_scene_class(module);
    add_mesh_class(module);
    module.def("reconstruct_scene", &reconstruct_scene);
    module.def("consume_scene", &consume_scene);
    module.def("reconstruct_model", &reconstruct_model);
    module.def("texture_mesh", &texture_mesh);
    module.def("read_scene", &read_scene);
    module.def("compare_meshes", &compare_meshes);
    module.def("declared_options", &declared_options);
}

} // namespace vcarve::python
