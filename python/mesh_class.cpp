#include "mesh_class.h"

#include "arrays.h"
#include "base/text.h"
#include "base/version.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

namespace vcarve::python {

namespace {

void require_corners(const TriMesh& mesh)
{
    for (const Face& face : mesh.faces) {
        const std::uint32_t last = std::ranges::max(face);
        if (last < mesh.positions.size()) continue;
        throw UsageError(fmt::format("a face has vertex {}, but there are {}, counted from 0", last,
                                     mesh.positions.size()));
    }
}

void require_one_a_vertex(std::size_t entries, std::size_t vertices, const char* name)
{
    if (entries == vertices) return;
    throw UsageError(
        fmt::format("{} {} are not one for each of {} vertices", entries, name, vertices));
}

std::shared_ptr<Mesh> mesh_of(const Given<double>& vertices, const Given<std::uint32_t>& faces,
                              const py::object& colors, const py::object& normals)
{
    auto mesh = std::make_shared<Mesh>();
    TriMesh& surface = mesh->surface;
    surface.positions = rows_of<Eigen::Vector3d>(vertices, "vertices");
    surface.faces = rows_of<Face>(faces, "faces");
    require_corners(surface);
    if (!colors.is_none()) {
        surface.colors = rows_of<Color>(py::cast<Given<std::uint8_t>>(colors), "colors");
        require_one_a_vertex(surface.colors.size(), surface.positions.size(), "colors");
    }
    if (!normals.is_none()) {
        surface.normals = rows_of<Eigen::Vector3f>(py::cast<Given<float>>(normals), "normals");
        require_one_a_vertex(surface.normals.size(), surface.positions.size(), "normals");
    }
    return mesh;
}

void write(const Mesh& mesh, const std::filesystem::path& path, bool ascii,
           const Eigen::Vector3d& offset)
{
    // Only PLY has room for it.
    const bool has_provenance =
        !mesh.provenance.point_ids.empty() && lower_case_end(path) == ".ply";
    const MeshFormat format = {.ascii = ascii,
                               .comments = {"made by colmap-vcarve " + versions().program},
                               .provenance = has_provenance ? &mesh.provenance : nullptr,
                               .offset = offset};
    const py::gil_scoped_release released;
    write_mesh(path, mesh.surface, format);
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

/// A property that is an array of the mesh, at its address.
template <typename Part, typename Entry>
auto array_of(Part Mesh::*part, std::vector<Entry> Part::*field)
{
    return [part, field](const std::shared_ptr<Mesh>& mesh) {
        return view_of(((*mesh).*part).*field, mesh);
    };
}

} // namespace

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
        .def_readonly("counts", &Mesh::counts)
        .def("write", &write, py::arg("path"), py::kw_only(), py::arg("ascii") = false,
             py::arg("offset") = Eigen::Vector3d(Eigen::Vector3d::Zero()));
    module.def("read_mesh", &read, py::arg("path"));
}

} // namespace vcarve::python
