#include "base/parallel.h"
#include "io/ply/ply_file.h"
#include "model/scene_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace vcarve {

namespace {

/// The number of vertices between two progress reports.
constexpr std::size_t kVerticesBetweenTells = 16384;

std::string_view text_of(const MappedFile& file)
{
    return {file.bytes().data(), file.bytes().size()};
}

std::string not_finite(const Eigen::Vector3d& place)
{
    return fmt::format("its scanner position is ({}), expected finite numbers",
                       fmt::join(place, ", "));
}

} // namespace

PlyReader::PlyReader(const std::filesystem::path& path, PlyContent content)
    : path_(path),
      file_(path),
      header_(parse_ply_header(text_of(file_), path_)),
      data_(text_of(file_), header_, path_),
      vertices_(find_vertices()),
      layout_(vertices_)
{
    if (content == PlyContent::mesh) {
        faces_ = header_.find("face");
        if (faces_ == nullptr) {
            data_.refuse("has no element \"face\", expected a mesh");
        }
    }
    if (!layout_.has_positions()) {
        data_.refuse("the vertices lack one of the properties x, y and z");
    }
    const PlyScanners wanted =
        content == PlyContent::points_and_scanners ? scanners_in(header_) : PlyScanners::none;
    with_scanners_ = wanted == PlyScanners::each;
    if (with_scanners_) require_all("the vertices have", vertices_, names_of_scanner(vertices_));
    if (wanted == PlyScanners::one_for_all) camera_ = header_.find(kPlyCamera);
    for (const PlyElement& element : header_.elements) {
        data_.require_room(element);
        if (&element == &vertices_) break;
        pass(element);
    }
}

PointCloud PlyReader::next(std::size_t most, const Progress& progress)
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
    require_finite(cloud);
    done_ += count;
    if (done_ == vertices_.count) {
        const PlyElement* const end = header_.elements.data() + header_.elements.size();
        for (const PlyElement* element = &vertices_ + 1; element != end; ++element) {
            if (faces_ == nullptr && (camera_ == nullptr || place_of_camera_)) break;
            data_.require_room(*element);
            pass(*element);
        }
        if (camera_ != nullptr) cloud.scanners.push_back(*place_of_camera_);
    }
    file_.release(file_.bytes().size() - data_.bytes_left());
    return cloud;
}

const PlyElement& PlyReader::find_vertices() const
{
    const PlyElement* const vertices = header_.find("vertex");
    if (vertices == nullptr) data_.refuse("has no element \"vertex\"");
    return *vertices;
}

/// Throws InputError unless the element has all three coordinates of a scanner position.
void PlyReader::require_all(const char* who_has, const PlyElement& element,
                            const PlyNames& names) const
{
    if (count_names(element, names) == static_cast<int>(names.size())) return;
    const auto is_there = [&](std::string_view name) {
        return count_names(element, {name, name, name}) > 0;
    };
    std::vector<std::string_view> found;
    std::ranges::copy_if(names, std::back_inserter(found), is_there);
    data_.refuse(fmt::format("{} only {}, expected the scanner position as {}, {} and {}", who_has,
                             fmt::join(found, " and "), names[0], names[1], names[2]));
}

/// Throws InputError if a vertex of a mesh, or the scanner of a finite point, is invalid.
void PlyReader::require_finite(const PointCloud& cloud) const
{
    for (std::size_t i = 0; faces_ != nullptr && i < cloud.positions.size(); ++i) {
        if (cloud.positions[i].allFinite()) continue;
        data_.refuse(fmt::format("vertex {} of {}: its position is ({}), expected finite numbers",
                                 done_ + i, vertices_.count, fmt::join(cloud.positions[i], ", ")));
    }
    for (std::size_t i = 0; i < cloud.scanners.size(); ++i) {
        const Eigen::Vector3d& place = cloud.scanners[i];
        if (is_valid_position(place) || !cloud.positions[i].allFinite()) continue;
        data_.refuse(
            fmt::format("vertex {} of {}: {}", done_ + i, vertices_.count, not_finite(place)));
    }
}

void PlyReader::pass(const PlyElement& element)
{
    if (&element == camera_) return read_camera();
    &element == faces_ ? read_faces() : data_.skip_all(element);
}

void PlyReader::read_camera()
{
    if (camera_->count != 1) {
        data_.refuse(fmt::format("has {} entries \"{}\", expected one with the scanner position",
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
        if (!is_valid_position(place)) throw BadPlyEntry{not_finite(place)};
    });
    place_of_camera_ = place + header_.offset;
}

void PlyReader::read_faces()
{
    const auto is_corners = [](const PlyProperty& property) {
        const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
        return named && property.length_type && is_integer(property.type);
    };
    const auto corners = std::ranges::find_if(faces_->properties, is_corners);
    if (corners == faces_->properties.end()) {
        data_.refuse("the faces have no list \"vertex_indices\" of integers");
    }
    read_faces_.reserve(faces_->count);
    data_.read_all(*faces_, [&](std::uint64_t) {
        for (auto p = faces_->properties.begin(); p != faces_->properties.end(); ++p) {
            p == corners ? read_face(*p) : data_.skip(*p);
        }
    });
}

/// Splits a polygon into a triangle fan around its first corner.
void PlyReader::read_face(const PlyProperty& corners)
{
    const std::size_t length = data_.list_length(corners);
    if (length < 3) {
        throw BadPlyEntry{fmt::format("it has {} corners, expected 3 or more", length)};
    }
    const std::uint32_t first = corner(corners.type);
    std::uint32_t previous = corner(corners.type);
    for (std::size_t i = 2; i < length; ++i) {
        const std::uint32_t next = corner(corners.type);
        read_faces_.push_back({first, previous, next});
        previous = next;
    }
}

std::uint32_t PlyReader::corner(PlyType type)
{
    const double index = data_.number(type);
    const bool exists = index >= 0.0 && index < static_cast<double>(vertices_.count);
    if (!exists || index != std::floor(index)) {
        throw BadPlyEntry{
            fmt::format("it uses vertex {}, but there are {} vertices", index, vertices_.count)};
    }
    return static_cast<std::uint32_t>(index);
}

void PlyReader::read_parallel(PointCloud& cloud, std::size_t vertex_bytes, const Progress& progress)
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

void PlyReader::read_in_order(PointCloud& cloud, const Progress& progress)
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
            progress.report(static_cast<double>(i), static_cast<double>(count));
        }
    });
}

void PlyReader::put(PointCloud& cloud, std::size_t i, const PlyVertex& vertex) const
{
    cloud.positions[i] =
        faces_ != nullptr ? vertex.position : position_or_nan(vertex.position + header_.offset);
    if (!cloud.normals.empty()) cloud.normals[i] = vertex.normal;
    if (!cloud.colors.empty()) cloud.colors[i] = vertex.color;
    if (with_scanners_) cloud.scanners[i] = vertex.scanner + header_.offset;
    if (!cloud.splats.empty()) cloud.splats[i] = vertex.splat;
}

PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress,
                          PlyContent content)
{
    PlyReader reader(path, content);
    return reader.next(reader.num_points(), progress);
}

TriMesh read_ply(const std::filesystem::path& path)
{
    PlyReader reader(path, PlyContent::mesh);
    PointCloud vertices = reader.next(reader.num_points());
    TriMesh mesh;
    mesh.positions = std::move(vertices.positions);
    mesh.faces = reader.take_faces();
    mesh.colors = std::move(vertices.colors);
    mesh.normals = std::move(vertices.normals);
    mesh.offset = reader.offset();
    return mesh;
}

PlyHeader read_ply_header(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return parse_ply_header(text_of(file), path);
}

} // namespace vcarve
