#include "io/formats/mesh_reader.h"

#include "base/text.h"
#include "geometry/cgal_kernel.h"
#include "io/files/mapped_file.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace vcarve {

namespace {

namespace fs = std::filesystem;

struct Polygons {
    std::vector<Cartesian::Point_3> points;
    std::vector<std::vector<std::size_t>> corners;
};

bool read_polygons(const fs::path& path, Polygons& polygons)
{
    const std::string end = lower_case_end(path);
    const std::string name = path.string();
    auto& [points, corners] = polygons;
    try {
        if (end == ".obj") return CGAL::IO::read_OBJ(name, points, corners);
        if (end == ".off") return CGAL::IO::read_OFF(name, points, corners);
        return CGAL::IO::read_STL(name, points, corners);
    } catch (const std::length_error&) {
        return false; // the header declares more elements than fit into memory
    } catch (const std::bad_alloc&) {
        return false;
    }
}

TriMesh triangles(const Polygons& polygons, const fs::path& path)
{
    TriMesh mesh;
    for (const auto& point : polygons.points) {
        const Eigen::Vector3d& position =
            mesh.positions.emplace_back(point.x(), point.y(), point.z());
        if (!position.allFinite())
            throw InputError(fmt::format("{}: vertex {} has a coordinate that is not finite",
                                         path.string(), mesh.positions.size()));
    }
    for (std::size_t i = 0; i < polygons.corners.size(); ++i) {
        const auto& corners = polygons.corners[i];
        for (const std::size_t corner : corners) {
            if (corner >= mesh.positions.size())
                throw InputError(fmt::format("{}: face {} uses vertex {} of {}", path.string(),
                                             i + 1, corner + 1, mesh.positions.size()));
        }
        for (std::size_t k = 2; k < corners.size(); ++k) {
            mesh.faces.push_back({static_cast<std::uint32_t>(corners[0]),
                                  static_cast<std::uint32_t>(corners[k - 1]),
                                  static_cast<std::uint32_t>(corners[k])});
        }
    }
    return mesh;
}

} // namespace

void require_readable_mesh_name(const fs::path& path)
{
    const std::string end = lower_case_end(path);
    if (end == ".ply" || end == ".obj" || end == ".off" || end == ".stl") return;
    throw UsageError(fmt::format("cannot read {}: the name of a mesh must end with .ply, "
                                 ".obj, .off or .stl",
                                 path.string()));
}

TriMesh read_mesh(const fs::path& path)
{
    require_readable_mesh_name(path);
    TriMesh mesh;
    if (lower_case_end(path) == ".ply") {
        mesh = read_ply(path);
    } else {
        const std::string fault = file_problem(path);
        if (!fault.empty()) throw InputError(fmt::format("{}: {}", path.string(), fault));
        Polygons polygons;
        if (!read_polygons(path, polygons))
            throw InputError(
                fmt::format("{}: does not match the format of its extension, is truncated, "
                            "or has no faces; export it again as .ply or .obj",
                            path.string()));
        mesh = triangles(polygons, path);
    }
    std::erase_if(mesh.faces, [](const Face& face) {
        return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    });
    if (mesh.faces.empty()) throw InputError(fmt::format("{}: has no faces", path.string()));
    return mesh;
}

} // namespace vcarve
