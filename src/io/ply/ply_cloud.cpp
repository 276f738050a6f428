#include "io/ply/ply_cloud.h"

#include "base/parallel.h"
#include "io/files/mapped_file.h"
#include "io/ply/ply_entries.h"
#include "io/ply/ply_vertex.h"
#include "vcarve/error.h"

#include <string_view>

namespace vcarve {

namespace {

/// So many vertices are read between two calls of Progress::tell.
constexpr std::size_t kVerticesBetweenTells = 16384;

std::string_view text_of(const MappedFile& file)
{
    return {file.bytes().data(), file.bytes().size()};
}

/// Reads the vertices of a file.
template <typename Body>
class CloudReader {
  public:
    CloudReader(const PlyHeader& header, Body body, const std::filesystem::path& path)
        : header_(header), entries_(body, path), path_(path)
    {
    }

    PointCloud read(const Progress& progress)
    {
        const PlyElement* const vertices = header_.find("vertex");
        if (vertices == nullptr) entries_.refuse("has no element \"vertex\"");
        const PlyVertexLayout layout(*vertices);
        if (!layout.has_positions()) {
            entries_.refuse("the vertices lack one of the properties x, y and z");
        }
        for (const PlyElement& element : header_.elements) {
            entries_.require_room(element);
            if (&element == vertices) break;
            entries_.skip_all(element);
        }
        cloud_.positions.resize(vertices->count);
        if (layout.has_normals()) cloud_.normals.resize(vertices->count);
        if (layout.has_colors()) cloud_.colors.resize(vertices->count);
        if (const auto bytes = Body::fixed_bytes(*vertices)) {
            read_parallel(layout, *bytes, progress);
        } else {
            read_in_order(layout, *vertices, progress);
        }
        return std::move(cloud_);
    }

  private:
    void read_parallel(const PlyVertexLayout& layout, std::size_t vertex_bytes,
                       const Progress& progress)
    {
        const auto read_range = [&](std::size_t first, std::size_t last) {
            PlyEntries<Body> entries(entries_.body(), path_);
            entries.body().skip_bytes(first * vertex_bytes);
            for (std::size_t i = first; i != last; ++i) {
                put(i, layout.read(entries));
            }
        };
        parallel_for_ranges(cloud_.positions.size(), progress, read_range, kVerticesBetweenTells);
    }

    void read_in_order(const PlyVertexLayout& layout, const PlyElement& vertices,
                       const Progress& progress)
    {
        const auto all = static_cast<double>(vertices.count);
        entries_.read_all(vertices, [&](std::uint64_t i) {
            put(i, layout.read(entries_));
            if (i % kVerticesBetweenTells == 0) progress.tell(static_cast<double>(i), all);
        });
    }

    void put(std::size_t i, const PlyVertex& vertex)
    {
        cloud_.positions[i] = vertex.position + header_.offset;
        if (!cloud_.normals.empty()) cloud_.normals[i] = vertex.normal;
        if (!cloud_.colors.empty()) cloud_.colors[i] = vertex.color;
    }

    const PlyHeader& header_;
    PlyEntries<Body> entries_;
    const std::filesystem::path& path_;
    PointCloud cloud_;
};

} // namespace

PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress)
{
    const MappedFile file(path);
    const std::string_view bytes = text_of(file);
    const PlyHeader header = parse_ply_header(bytes, path);
    return visit_ply_body(bytes, header, [&](auto body) {
        return CloudReader<decltype(body)>(header, body, path).read(progress);
    });
}

PlyHeader read_ply_header(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return parse_ply_header(text_of(file), path);
}

} // namespace vcarve
