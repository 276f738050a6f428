// The compiled part of `import vcarve`: its classes, and runs with a listener. Users call the
// functions in vcarve/__init__.py, which has the keywords.
#include "arguments.h"
#include "arrays.h"
#include "base/version.h"
#include "logged_run.h"
#include "mesh_class.h"
#include "options/declared.h"
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

namespace vcarve::python {

namespace {

namespace fs = std::filesystem;

std::shared_ptr<Mesh> mesh_of(Reconstruction made, bool attributes)
{
    auto mesh = std::make_shared<Mesh>();
    if (attributes) mesh->provenance = find_provenance(made.mesh, made.scene);
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
                                        const py::dict& keywords, bool attributes,
                                        const py::object& listener)
{
    const auto options = options_from<Options>(keywords);
    std::optional<Reconstruction> made;
    run_told(listener, [&](Log& log) { made = reconstruct(Scene(*scene), options, log); });
    return mesh_of(std::move(*made), attributes);
}

/// Moves the arrays of the scene instead of copying them; the scene is empty afterwards.
std::shared_ptr<Mesh> consume_scene(const std::shared_ptr<Scene>& scene, const py::dict& keywords,
                                    bool attributes, const py::object& listener)
{
    const auto options = options_from<Options>(keywords);
    require_unseen(scene);
    std::optional<Reconstruction> made;
    run_told(listener,
             [&](Log& log) { made = reconstruct(std::exchange(*scene, Scene()), options, log); });
    return mesh_of(std::move(*made), attributes);
}

std::shared_ptr<Mesh> reconstruct_model(const fs::path& model, const py::dict& input,
                                        const py::dict& keywords, bool attributes,
                                        const py::object& listener)
{
    const PointsOptions points = points_of(input);
    const auto options = options_from<Options>(keywords);
    std::optional<Reconstruction> made;
    run_told(listener, [&](Log& log) { made = reconstruct(model, points, options, log); });
    return mesh_of(std::move(*made), attributes);
}

std::shared_ptr<Scene> read_scene(const fs::path& model, const py::dict& input,
                                  const py::object& listener)
{
    const PointsOptions points = points_of(input);
    auto scene = std::make_shared<Scene>();
    run_told(listener, [&](Log& log) { *scene = read_model(model, points, log); });
    return scene;
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
    module.def("read_scene", &read_scene);
    module.def("compare_meshes", &compare_meshes);
    module.def("declared_options", &declared_options);
}

} // namespace vcarve::python
