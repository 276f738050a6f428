#include "io/ply/ply_cloud.h"

#include "base/parallel.h"
#include "model/scene_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
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

std::string not_finite(const Eigen::Vector3d& place)
{
    return fmt::format("its scanner stands at ({}), expected finite numbers",
                       fmt::join(place, ", "));
}

} // namespace

PlyCloudReader::PlyCloudReader(const std::filesystem::path& path, ReadScanners scanners)
    : path_(path),
      file_(path),
      header_(parse_ply_header(text_of(file_), path_)),
      data_(text_of(file_), header_, path_),
      vertices_(find_vertices()),
      layout_(vertices_)
{
    if (!layout_.has_positions()) {
        data_.refuse("the vertices lack one of the properties x, y and z");
    }
    const PlyScanners wanted =
        scanners == ReadScanners::yes ? scanners_in(header_) : PlyScanners::none;
    with_scanners_ = wanted == PlyScanners::each;
    if (with_scanners_) require_all("the vertices have", vertices_, names_of_scanner(vertices_));
    if (wanted == PlyScanners::one_for_all) camera_ = header_.find(kPlyCamera);
    for (const PlyElement& element : header_.elements) {
        data_.require_room(element);
        if (&element == &vertices_) break;
        pass(element);
    }
}

PointCloud PlyCloudReader::next(std::size_t most, const Progress& progress)
{
    const std::size_t count = std::min(most, vertices_.count - done_);
    PointCloud cloud;
    cloud.positions.resize(count);
    if (layout_.has_normals()) cloud.normals.resize(count);
    if (layout_.has_colors()) cloud.colors.resize(count);
    if (with_scanners_) cloud.scanners.resize(count);
    if (layout_.are_splats()) cloud.splats.resize(count);
    if (const auto bytes = data_.bytes_of_entry(vertices_)) {
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
    file_.release(file_.bytes().size() - data_.bytes_left());
    return cloud;
}

const PlyElement& PlyCloudReader::find_vertices() const
{
    const PlyElement* const vertices = header_.find("vertex");
    if (vertices == nullptr) data_.refuse("has no element \"vertex\"");
    return *vertices;
}

/// Less than three coordinates are no place.
void PlyCloudReader::require_all(const char* who_has, const PlyElement& element,
                                 const PlyNames& names) const
{
    if (count_names(element, names) == static_cast<int>(names.size())) return;
    const auto is_there = [&](std::string_view name) {
        return count_names(element, {name, name, name}) > 0;
    };
    std::vector<std::string_view> found;
    std::ranges::copy_if(names, std::back_inserter(found), is_there);
    data_.refuse(fmt::format("{} {} only, expected {}, {} and {} to say where the scanner stood",
                             who_has, fmt::join(found, " and "), names[0], names[1], names[2]));
}

/// Points that are not finite were not measured, from wherever.
void PlyCloudReader::require_finite_scanners(const PointCloud& cloud) const
{
    for (std::size_t i = 0; i < cloud.scanners.size(); ++i) {
        const Eigen::Vector3d& place = cloud.scanners[i];
        if (is_place(place) || !cloud.positions[i].allFinite()) continue;
        data_.refuse(
            fmt::format("vertex {} of {}: {}", done_ + i, vertices_.count, not_finite(place)));
    }
}

void PlyCloudReader::pass(const PlyElement& element)
{
    &element == camera_ ? read_camera() : data_.skip_all(element);
}

void PlyCloudReader::read_camera()
{
    if (camera_->count != 1) {
        data_.refuse(fmt::format("has {} entries \"{}\", expected the one where the scanner stood",
                                 camera_->count, camera_->name));
    }
    require_all("the camera has", *camera_, kPlyCameraPlace);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    data_.read_all(*camera_, [&](std::uint64_t) {
        for (const PlyProperty& property : camera_->properties) {
            const auto* const name = std::ranges::find(kPlyCameraPlace, property.name);
            if (name == kPlyCameraPlace.end() || property.length_type) {
                data_.skip(property);
            } else {
                place[name - kPlyCameraPlace.begin()] = data_.number(property.type);
            }
        }
        if (!is_place(place)) throw BadPlyEntry{not_finite(place)};
    });
    place_of_camera_ = place + header_.offset;
}

/// Where the camera does not stand before the vertices.
void PlyCloudReader::find_camera_behind()
{
    for (const PlyElement* element = &vertices_ + 1; !place_of_camera_; ++element) {
        data_.require_room(*element);
        pass(*element);
    }
}

void PlyCloudReader::read_parallel(PointCloud& cloud, std::size_t vertex_bytes,
                                   const Progress& progress)
{
    const auto read_range = [&](std::size_t first, std::size_t last) {
        PlyData data = data_;
        data.skip_bytes(first * vertex_bytes);
        for (std::size_t i = first; i != last; ++i) {
            put(cloud, i, layout_.read(data));
        }
    };
    parallel_for_ranges(cloud.positions.size(), progress, read_range, kVerticesBetweenTells);
    data_.skip_bytes(cloud.positions.size() * vertex_bytes);
}

void PlyCloudReader::read_in_order(PointCloud& cloud, const Progress& progress)
{
    const std::size_t count = cloud.positions.size();
    const bool has_images = layout_.has_images();
    std::vector<std::uint32_t> images;
    data_.read_some(vertices_, {done_, done_ + count}, [&](std::uint64_t vertex) {
        const std::size_t i = vertex - done_;
        images.clear();
        put(cloud, i, layout_.read(data_, &images));
        if (has_images) cloud.images.push_back(images);
        if (i % kVerticesBetweenTells == 0) {
            progress.tell(static_cast<double>(i), static_cast<double>(count));
        }
    });
}

void PlyCloudReader::put(PointCloud& cloud, std::size_t i, const PlyVertex& vertex) const
{
    cloud.positions[i] = place_or_none(vertex.position + header_.offset);
    if (!cloud.normals.empty()) cloud.normals[i] = vertex.normal;
    if (!cloud.colors.empty()) cloud.colors[i] = vertex.color;
    if (with_scanners_) cloud.scanners[i] = vertex.scanner + header_.offset;
    if (!cloud.splats.empty()) cloud.splats[i] = vertex.splat;
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
