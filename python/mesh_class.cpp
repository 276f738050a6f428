#include "mesh_class.h"

#include "arrays.h"
#include "base/text.h"
#include "base/version.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <tuple>

namespace vcarve::python {

namespace {

template <typename Rows, typename IsValid>
void require_all(const Rows& rows, const char* name, const IsValid& is_valid,
                 const std::string& fault)
{
    const auto wrong = std::ranges::find_if_not(rows, is_valid);
    if (wrong == rows.end()) return;
    throw UsageError(fmt::format("{}[{}] {}", name, wrong - rows.begin(), fault));
}

/// Throws UsageError for invalid arrays. Users can write into the arrays of a mesh at any time.
void require_valid(const TriMesh& mesh)
{
    const auto is_finite = [](const auto& vector) { return vector.allFinite(); };
    require_all(mesh.positions, "vertices", is_finite, "is not finite");
    require_all(mesh.normals, "normals", is_finite, "is not finite");
    require_corners(mesh);
    const auto differ = [](const Face& f) { return f[0] != f[1] && f[1] != f[2] && f[2] != f[0]; };
    require_all(mesh.faces, "faces", differ, "is degenerate: it has a vertex twice");
}

template <typename Entry>
void set_of_vertices(std::vector<Entry>& rows, const py::object& given, const char* name,
                     std::size_t vertices)
{
    if (!given.is_none()) rows = rows_of<Entry>(given, name);
    if (given.is_none() || rows.size() == vertices) return;
    throw UsageError(fmt::format("found {} {}, but expected one for each of {} vertices",
                                 rows.size(), name, vertices));
}

std::shared_ptr<Mesh> mesh_of(const py::object& vertices, const py::object& faces,
                              const py::object& colors, const py::object& normals)
{
    auto mesh = std::make_shared<Mesh>();
    TriMesh& surface = mesh->surface;
    surface.positions = rows_of<Eigen::Vector3d>(vertices, "vertices");
    surface.faces = rows_of<Face>(faces, "faces");
    set_of_vertices(surface.colors, colors, "colors", surface.positions.size());
    set_of_vertices(surface.normals, normals, "normals", surface.positions.size());
    require_valid(surface);
    return mesh;
}

/// The mesh as the run made it, unless a user has changed its vertices since; else null.
std::optional<TriMesh> mesh_of_run(const Mesh& mesh)
{
    const auto& now = mesh.surface.positions;
    const auto is_same = [&](const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
        return before + mesh.run_offset == after;
    };
    if (now.empty() || !std::ranges::equal(mesh.run_positions, now, is_same)) return std::nullopt;
    TriMesh made = mesh.surface;
    made.positions = mesh.run_positions;
    made.offset = mesh.run_offset;
    return made;
}

void write(const Mesh& mesh, const std::filesystem::path& path, bool ascii,
           const Eigen::Vector3d& offset)
{
    require_valid(mesh.surface);
    if (!offset.allFinite()) throw UsageError("the offset is not finite");
    // Only some formats can store these.
    const std::string end = lower_case_end(path);
    const bool has_provenance = !mesh.provenance.point_ids.empty() && end == ".ply";
    const bool has_texture =
        !mesh.texture.is_empty() && (end == ".glb" || end == ".obj" || end == ".ply");
    MeshFormat format = {.ascii = ascii,
                         .comments = mesh.comments,
                         .provenance = has_provenance ? &mesh.provenance : nullptr,
                         .texture = has_texture ? &mesh.texture : nullptr,
                         .offset = offset,
                         .up = mesh.up};
    if (format.comments.empty()) {
        format.comments = {"made by colmap-vcarve " + versions().program};
    }
    const py::gil_scoped_release released;
    const std::optional<TriMesh> made = end == ".glb" ? mesh_of_run(mesh) : std::nullopt;
    write_mesh(path, made ? *made : mesh.surface, format);
}

std::shared_ptr<Mesh> read(const std::filesystem::path& path)
{
    const py::gil_scoped_release released;
    TriMesh surface = in_frame_of_model(read_ply(path));
    const py::gil_scoped_acquire acquired;
    auto mesh = std::make_shared<Mesh>();
    mesh->surface = std::move(surface);
    return mesh;
}

auto arrays_of(Mesh& mesh)
{
    return std::tie(mesh.surface.positions, mesh.surface.faces, mesh.surface.colors,
                    mesh.surface.normals, mesh.surface.points, mesh.provenance.point_ids,
                    mesh.provenance.num_views, mesh.provenance.errors_px, mesh.provenance.supports);
}

/// (pages, page_of_face, places): pages are arrays (height, width, 3), and places are positions of
/// corners in their pages, (faces, 3, 2). None without a texture.
py::object texture_of(const std::shared_ptr<Mesh>& mesh)
{
    Texture& texture = mesh->texture;
    if (texture.is_empty()) return py::none();
    py::list pages;
    for (Photograph& page : texture.pages) {
        pages.append(view_of(page.rgb, mesh).attr("reshape")(page.height_px, page.width_px, 3));
    }
    auto* const first = reinterpret_cast<float*>(texture.places.data());
    const auto faces = static_cast<py::ssize_t>(texture.places.size());
    return py::make_tuple(
        pages, view_of(texture.page_of_face, mesh),
        py::array_t<float>({faces, py::ssize_t{3}, py::ssize_t{2}}, first, py::cast(mesh)));
}

/// The reverse of texture_of(); copies.
Texture texture_from(const py::object& given)
{
    Texture texture;
    if (given.is_none()) return texture;
    const auto [pages, page_of_face, places] =
        py::cast<std::tuple<std::vector<py::array_t<std::uint8_t, py::array::c_style>>,
                            std::vector<std::uint32_t>, py::array_t<float, py::array::c_style>>>(
            given);
    for (const auto& page : pages) {
        texture.pages.push_back({static_cast<int>(page.shape(1)),
                                 static_cast<int>(page.shape(0)),
                                 {page.data(), page.data() + page.size()}});
    }
    texture.page_of_face = page_of_face;
    texture.places.resize(page_of_face.size());
    std::copy_n(places.data(), places.size(), reinterpret_cast<float*>(texture.places.data()));
    return texture;
}

py::tuple state_of(const std::shared_ptr<Mesh>& mesh)
{
    return py::make_tuple(tuple_of_arrays(arrays_of(*mesh), mesh), mesh->counts, texture_of(mesh),
                          mesh->comments, mesh->up);
}

std::shared_ptr<Mesh> unpickled(const py::tuple& state)
{
    auto mesh = std::make_shared<Mesh>();
    set_arrays(arrays_of(*mesh), state[0]);
    mesh->counts = state[1].attr("copy")();
    mesh->texture = texture_from(state[2]);
    mesh->comments = py::cast<std::vector<std::string>>(state[3]);
    mesh->up = py::cast<Eigen::Vector3d>(state[4]);
    return mesh;
}

/// A property that returns a NumPy array at the address of the mesh's array.
template <typename Part, typename Entry>
auto array_of(Part Mesh::*part, std::vector<Entry> Part::*field)
{
    return [part, field](const std::shared_ptr<Mesh>& mesh) {
        return view_of(((*mesh).*part).*field, mesh);
    };
}

} // namespace

void require_corners(const TriMesh& mesh)
{
    const std::size_t vertices = mesh.positions.size();
    const auto exists = [&](const Face& face) { return std::ranges::max(face) < vertices; };
    require_all(mesh.faces, "faces", exists,
                fmt::format("has a vertex that does not exist; there are {} vertices", vertices));
}

TriMesh in_frame_of_model(TriMesh mesh)
{
    for (Eigen::Vector3d& position : mesh.positions) {
        position += mesh.offset;
    }
    mesh.offset.setZero();
    return mesh;
}

void add_mesh_class(py::module_& module)
{
    py::class_<Mesh, std::shared_ptr<Mesh>>(module, "Mesh")
        .def(py::init(&mesh_of), py::arg("vertices"), py::arg("faces"),
             py::arg("colors") = py::none(), py::arg("normals") = py::none())
        .def_property_readonly("vertices", array_of(&Mesh::surface, &TriMesh::positions))
        .def_property_readonly("faces", array_of(&Mesh::surface, &TriMesh::faces))
        .def_property_readonly("colors", array_of(&Mesh::surface, &TriMesh::colors))
        .def_property_readonly("normals", array_of(&Mesh::surface, &TriMesh::normals))
        .def_property_readonly("point_ids", array_of(&Mesh::provenance, &Provenance::point_ids))
        .def_property_readonly("num_views", array_of(&Mesh::provenance, &Provenance::num_views))
        .def_property_readonly("errors_px", array_of(&Mesh::provenance, &Provenance::errors_px))
        .def_property_readonly("support", array_of(&Mesh::provenance, &Provenance::supports))
        .def_property_readonly("_texture", &texture_of)
        .def_readonly("counts", &Mesh::counts)
        .def(py::pickle(&state_of, &unpickled))
        .def("write", &write, py::arg("path"), py::kw_only(), py::arg("ascii") = false,
             py::arg("offset") = Eigen::Vector3d(Eigen::Vector3d::Zero()));
    module.def("read_mesh", &read, py::arg("path"));
}

} // namespace vcarve::python
