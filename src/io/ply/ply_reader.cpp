#include "io/files/mapped_file.h"
#include "io/ply/ply_vertex.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

/// Reads the data behind a header, element by element.
class MeshReader {
  public:
    MeshReader(const PlyHeader& header, const PlyData& data) : header_(header), data_(data) {}

    TriMesh read()
    {
        mesh_.offset = header_.offset;
        if (header_.find("vertex") == nullptr) data_.refuse("has no element \"vertex\"");
        num_vertices_ = header_.find("vertex")->count;
        if (header_.find("face") == nullptr) {
            data_.refuse("has points but no element \"face\", expected a surface");
        }
        for (const PlyElement& element : header_.elements) {
            data_.require_room(element);
            if (&element == header_.find("vertex")) {
                read_vertices(element);
            } else if (&element == header_.find("face")) {
                read_faces(element);
            } else {
                data_.skip_all(element);
            }
        }
        return std::move(mesh_);
    }

  private:
    void read_vertices(const PlyElement& element)
    {
        const PlyVertexLayout layout(element);
        if (!layout.has_positions()) {
            data_.refuse("the vertices lack one of the properties x, y and z");
        }
        mesh_.positions.resize(element.count);
        if (layout.has_normals()) mesh_.normals.resize(element.count);
        if (layout.has_colors()) mesh_.colors.resize(element.count);
        data_.read_all(element, [&](std::uint64_t i) { put(i, layout.read(data_)); });
    }

    void put(std::uint64_t i, const PlyVertex& vertex)
    {
        const Eigen::Vector3d& position = vertex.position;
        if (!position.allFinite()) {
            throw BadPlyEntry{fmt::format("its position is ({}, {}, {}), expected finite numbers",
                                          position.x(), position.y(), position.z())};
        }
        mesh_.positions[i] = position;
        if (!mesh_.normals.empty()) mesh_.normals[i] = vertex.normal;
        if (!mesh_.colors.empty()) mesh_.colors[i] = vertex.color;
    }

    void read_faces(const PlyElement& element)
    {
        const auto is_corners = [](const PlyProperty& property) {
            const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
            return named && property.length_type && is_integer(property.type);
        };
        const auto corners = std::ranges::find_if(element.properties, is_corners);
        if (corners == element.properties.end()) {
            data_.refuse("the faces have no list \"vertex_indices\" of integers");
        }
        mesh_.faces.reserve(element.count);
        data_.read_all(element, [&](std::uint64_t) {
            for (auto p = element.properties.begin(); p != element.properties.end(); ++p) {
                p == corners ? read_face(*p) : data_.skip(*p);
            }
        });
    }

    /// A polygon becomes a fan around its first corner.
    void read_face(const PlyProperty& corners)
    {
        const std::size_t length = data_.list_length(corners);
        if (length < 3) {
            throw BadPlyEntry{fmt::format("it has {} corners, expected 3 or more", length)};
        }
        const std::uint32_t first = corner(corners.type);
        std::uint32_t previous = corner(corners.type);
        for (std::size_t i = 2; i < length; ++i) {
            const std::uint32_t next = corner(corners.type);
            mesh_.faces.push_back({first, previous, next});
            previous = next;
        }
    }

    std::uint32_t corner(PlyType type)
    {
        const double index = data_.number(type);
        const bool exists = index >= 0.0 && index < static_cast<double>(num_vertices_);
        if (!exists || index != std::floor(index)) {
            throw BadPlyEntry{
                fmt::format("it uses vertex {}, but there are {} vertices", index, num_vertices_)};
        }
        return static_cast<std::uint32_t>(index);
    }

    const PlyHeader& header_;
    PlyData data_;
    std::uint64_t num_vertices_ = 0;
    TriMesh mesh_;
};

} // namespace

TriMesh read_ply(const std::filesystem::path& path)
{
    const MappedFile file(path);
    const std::string_view bytes(file.bytes().data(), file.bytes().size());
    const PlyHeader header = parse_ply_header(bytes, path);
    return MeshReader(header, PlyData(bytes, header, path)).read();
}

} // namespace vcarve
