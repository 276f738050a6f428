#include "io/ply/ply_cloud.h"

#include "base/parallel.h"
#include "io/files/mapped_file.h"
#include "io/ply/ply_entries.h"
#include "io/ply/ply_scanners.h"
#include "io/ply/ply_vertex.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
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

    PointCloud read(const Progress& progress, PlyScanners scanners)
    {
        const PlyElement* const vertices = header_.find("vertex");
        if (vertices == nullptr) entries_.refuse("has no element \"vertex\"");
        const PlyElement* const camera =
            scanners == PlyScanners::one_for_all ? header_.find(kPlyCamera) : nullptr;
        for (const PlyElement& element : header_.elements) {
            entries_.require_room(element);
            if (&element == vertices) {
                read_vertices(element, progress, scanners == PlyScanners::each);
            } else if (&element == camera) {
                read_camera(element);
            } else {
                entries_.skip_all(element);
            }
            if (&element >= vertices && (camera == nullptr || place_of_camera_)) break;
        }
        if (place_of_camera_) cloud_.scanners.push_back(*place_of_camera_);
        return std::move(cloud_);
    }

  private:
    void read_vertices(const PlyElement& vertices, const Progress& progress, bool with_scanners)
    {
        const PlyVertexLayout layout(vertices);
        if (!layout.has_positions()) {
            entries_.refuse("the vertices lack one of the properties x, y and z");
        }
        if (with_scanners) require_all("the vertices have", vertices, names_of_scanner(vertices));
        cloud_.positions.resize(vertices.count);
        if (layout.has_normals()) cloud_.normals.resize(vertices.count);
        if (layout.has_colors()) cloud_.colors.resize(vertices.count);
        if (with_scanners) cloud_.scanners.resize(vertices.count);
        if (const auto bytes = Body::fixed_bytes(vertices)) {
            read_parallel(layout, *bytes, progress);
            entries_.skip_all(vertices);
        } else {
            read_in_order(layout, vertices, progress);
        }
        require_finite_scanners();
    }

    /// Less than three coordinates are no place.
    void require_all(const char* who_has, const PlyElement& element, const PlyNames& names) const
    {
        if (count_names(element, names) == static_cast<int>(names.size())) return;
        const auto is_there = [&](std::string_view name) {
            return count_names(element, {name, name, name}) > 0;
        };
        std::vector<std::string_view> found;
        std::ranges::copy_if(names, std::back_inserter(found), is_there);
        entries_.refuse(fmt::format("{} {} only, expected {}, {} and {} to say where the scanner "
                                    "stood",
                                    who_has, fmt::join(found, " and "), names[0], names[1],
                                    names[2]));
    }

    /// Points that are not finite were not measured, from wherever.
    void require_finite_scanners() const
    {
        for (std::size_t i = 0; i < cloud_.scanners.size(); ++i) {
            const Eigen::Vector3d& place = cloud_.scanners[i];
            if (place.allFinite() || !cloud_.positions[i].allFinite()) continue;
            entries_.refuse(
                fmt::format("vertex {} of {}: {}", i, cloud_.scanners.size(), not_finite(place)));
        }
    }

    static std::string not_finite(const Eigen::Vector3d& place)
    {
        return fmt::format("its scanner stands at ({}), expected finite numbers",
                           fmt::join(place, ", "));
    }

    /// The camera that stands for all vertices.
    void read_camera(const PlyElement& camera)
    {
        if (camera.count != 1) {
            entries_.refuse(fmt::format("has {} entries \"{}\", expected the one where the scanner "
                                        "stood",
                                        camera.count, camera.name));
        }
        require_all("the camera has", camera, kPlyCameraPlace);
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        entries_.read_all(camera, [&](std::uint64_t) {
            for (const PlyProperty& property : camera.properties) {
                const auto* const name = std::ranges::find(kPlyCameraPlace, property.name);
                if (name == kPlyCameraPlace.end() || property.length_type) {
                    entries_.skip(property);
                } else {
                    place[name - kPlyCameraPlace.begin()] = entries_.number(property.type);
                }
            }
            if (!place.allFinite()) throw BadPlyEntry{not_finite(place)};
        });
        place_of_camera_ = place + header_.offset;
    }

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
        if (!cloud_.scanners.empty()) cloud_.scanners[i] = vertex.scanner + header_.offset;
    }

    const PlyHeader& header_;
    PlyEntries<Body> entries_;
    const std::filesystem::path& path_;
    PointCloud cloud_;
    std::optional<Eigen::Vector3d> place_of_camera_;
};

} // namespace

PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress,
                          ReadScanners scanners)
{
    const MappedFile file(path);
    const std::string_view bytes = text_of(file);
    const PlyHeader header = parse_ply_header(bytes, path);
    const PlyScanners wanted =
        scanners == ReadScanners::yes ? scanners_in(header) : PlyScanners::none;
    return visit_ply_body(bytes, header, [&](auto body) {
        return CloudReader<decltype(body)>(header, body, path).read(progress, wanted);
    });
}

PlyHeader read_ply_header(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return parse_ply_header(text_of(file), path);
}

} // namespace vcarve
