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

class PlyCloudReader::Vertices {
  public:
    Vertices() = default;
    Vertices(const Vertices&) = delete;
    Vertices& operator=(const Vertices&) = delete;
    virtual ~Vertices() = default;

    virtual std::size_t count() const = 0;
    /// What of the file is not read.
    virtual std::size_t bytes_left() const = 0;
    virtual PointCloud next(std::size_t most, const Progress& progress) = 0;
};

namespace {

/// So many vertices are read between two calls of Progress::tell.
constexpr std::size_t kVerticesBetweenTells = 16384;

std::string_view text_of(const MappedFile& file)
{
    return {file.bytes().data(), file.bytes().size()};
}

/// Reads the vertices of a file.
template <typename Body>
class CloudReader final : public PlyCloudReader::Vertices {
  public:
    CloudReader(const PlyHeader& header, Body body, const std::filesystem::path& path,
                PlyScanners scanners)
        : header_(header),
          entries_(body, path),
          path_(path),
          vertices_(find_vertices()),
          layout_(vertices_),
          with_scanners_(scanners == PlyScanners::each),
          camera_(scanners == PlyScanners::one_for_all ? header.find(kPlyCamera) : nullptr)
    {
        if (!layout_.has_positions()) {
            entries_.refuse("the vertices lack one of the properties x, y and z");
        }
        if (with_scanners_)
            require_all("the vertices have", vertices_, names_of_scanner(vertices_));
        for (const PlyElement& element : header.elements) {
            entries_.require_room(element);
            if (&element == &vertices_) break;
            pass(element);
        }
    }

    std::size_t count() const override { return vertices_.count; }
    std::size_t bytes_left() const override { return entries_.bytes_left(); }

    PointCloud next(std::size_t most, const Progress& progress) override
    {
        const std::size_t count = std::min(most, vertices_.count - done_);
        PointCloud cloud;
        cloud.positions.resize(count);
        if (layout_.has_normals()) cloud.normals.resize(count);
        if (layout_.has_colors()) cloud.colors.resize(count);
        if (with_scanners_) cloud.scanners.resize(count);
        if (const auto bytes = Body::fixed_bytes(vertices_)) {
            read_parallel(cloud, *bytes, progress);
        } else {
            read_in_order(cloud, progress);
        }
        require_finite_scanners(cloud);
        done_ += count;
        if (done_ == vertices_.count && camera_ != nullptr) {
            find_camera_behind();
            cloud.scanners.push_back(*place_of_camera_);
        }
        return cloud;
    }

  private:
    const PlyElement& find_vertices() const
    {
        const PlyElement* const vertices = header_.find("vertex");
        if (vertices == nullptr) entries_.refuse("has no element \"vertex\"");
        return *vertices;
    }

    void pass(const PlyElement& element)
    {
        if (&element == camera_) {
            read_camera(element);
        } else {
            entries_.skip_all(element);
        }
    }

    /// Where the camera does not stand before the vertices.
    void find_camera_behind()
    {
        for (const PlyElement* element = &vertices_ + 1; !place_of_camera_; ++element) {
            entries_.require_room(*element);
            pass(*element);
        }
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
    void require_finite_scanners(const PointCloud& cloud) const
    {
        for (std::size_t i = 0; i < cloud.scanners.size(); ++i) {
            const Eigen::Vector3d& place = cloud.scanners[i];
            if (place.allFinite() || !cloud.positions[i].allFinite()) continue;
            entries_.refuse(
                fmt::format("vertex {} of {}: {}", done_ + i, vertices_.count, not_finite(place)));
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

    void read_parallel(PointCloud& cloud, std::size_t vertex_bytes, const Progress& progress)
    {
        const auto read_range = [&](std::size_t first, std::size_t last) {
            PlyEntries<Body> entries(entries_.body(), path_);
            entries.body().skip_bytes(first * vertex_bytes);
            for (std::size_t i = first; i != last; ++i) {
                put(cloud, i, layout_.read(entries));
            }
        };
        parallel_for_ranges(cloud.positions.size(), progress, read_range, kVerticesBetweenTells);
        entries_.body().skip_bytes(cloud.positions.size() * vertex_bytes);
    }

    void read_in_order(PointCloud& cloud, const Progress& progress)
    {
        const std::size_t count = cloud.positions.size();
        entries_.read_some(vertices_, {done_, done_ + count}, [&](std::uint64_t vertex) {
            const std::size_t i = vertex - done_;
            put(cloud, i, layout_.read(entries_));
            if (i % kVerticesBetweenTells == 0) {
                progress.tell(static_cast<double>(i), static_cast<double>(count));
            }
        });
    }

    void put(PointCloud& cloud, std::size_t i, const PlyVertex& vertex) const
    {
        cloud.positions[i] = vertex.position + header_.offset;
        if (!cloud.normals.empty()) cloud.normals[i] = vertex.normal;
        if (!cloud.colors.empty()) cloud.colors[i] = vertex.color;
        if (!cloud.scanners.empty()) cloud.scanners[i] = vertex.scanner + header_.offset;
    }

    const PlyHeader& header_;
    PlyEntries<Body> entries_;
    const std::filesystem::path& path_;
    const PlyElement& vertices_;
    PlyVertexLayout layout_;
    bool with_scanners_;
    const PlyElement* camera_; ///< that stands for all vertices; null where none does
    std::uint64_t done_ = 0;   ///< vertices
    std::optional<Eigen::Vector3d> place_of_camera_;
};

} // namespace

PlyCloudReader::PlyCloudReader(const std::filesystem::path& path, ReadScanners scanners)
    : path_(path), file_(path), header_(parse_ply_header(text_of(file_), path_))
{
    const PlyScanners wanted =
        scanners == ReadScanners::yes ? scanners_in(header_) : PlyScanners::none;
    vertices_ =
        visit_ply_body(text_of(file_), header_, [&](auto body) -> std::unique_ptr<Vertices> {
            return std::make_unique<CloudReader<decltype(body)>>(header_, body, path_, wanted);
        });
}

PlyCloudReader::~PlyCloudReader() = default;

std::size_t PlyCloudReader::num_points() const
{
    return vertices_->count();
}

PointCloud PlyCloudReader::next(std::size_t most, const Progress& progress)
{
    PointCloud cloud = vertices_->next(most, progress);
    file_.release(file_.bytes().size() - vertices_->bytes_left());
    return cloud;
}

PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress,
                          ReadScanners scanners)
{
    PlyCloudReader reader(path, scanners);
    return reader.next(reader.num_points(), progress);
}

PlyHeader read_ply_header(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return parse_ply_header(text_of(file), path);
}

} // namespace vcarve
