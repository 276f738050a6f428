#include "geometry/triangle.h"
#include "io/files/block_writer.h"
#include "io/formats/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

namespace vcarve {
namespace {

template <typename Vector>
void put_triple(fmt::memory_buffer& block, const char* before, const Vector& triple)
{
    fmt::format_to(fmt::appender(block), "{}{} {} {}", before, triple[0], triple[1], triple[2]);
}

void put_comments(fmt::memory_buffer& block, const MeshFormat& format)
{
    for (const std::string& comment : comment_lines(format)) {
        fmt::format_to(fmt::appender(block), "# {}\n", comment);
    }
}

/// Appends a color from 0 to 1, rounded up to four decimals. Readers get the original byte, whether
/// they round or truncate.
void put_color(fmt::memory_buffer& block, const Color& color)
{
    constexpr int kOne = 10000;
    for (const std::uint8_t channel : color) {
        const int share = (kOne * channel + 254) / 255;
        fmt::format_to(fmt::appender(block), " {}.{:04}", share / kOne, share % kOne);
    }
}

void put_corner(fmt::memory_buffer& block, std::uint32_t vertex, bool has_normals)
{
    const std::uint64_t number = std::uint64_t{vertex} + 1;
    fmt::format_to(fmt::appender(block), " {}", number);
    if (has_normals) fmt::format_to(fmt::appender(block), "//{}", number);
}

constexpr std::size_t kHeaderBytes = 80;

/// The STL header. It must not begin with "solid", the first word of a text STL file.
std::string header_of(const MeshFormat& format)
{
    std::string header = fmt::format("STL, {}", fmt::join(comment_lines(format), ", "));
    header.resize(kHeaderBytes);
    return header;
}

void put_floats(fmt::memory_buffer& block, const Eigen::Vector3d& triple)
{
    for (int axis = 0; axis < 3; ++axis) {
        put_little_endian(block, static_cast<float>(triple[axis]));
    }
}

} // namespace

void write_obj(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const Eigen::Vector3d shift = mesh.offset - format.offset;
    BlockWriter writer(out);
    put_comments(writer.block(), format);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        fmt::memory_buffer& block = writer.block();
        const Eigen::Vector3d position = mesh.positions[v] + shift;
        put_triple(block, "v ", position);
        if (!mesh.colors.empty()) put_color(block, mesh.colors[v]);
        block.push_back('\n');
    }
    for (const Eigen::Vector3f& normal : mesh.normals) {
        fmt::memory_buffer& block = writer.block();
        put_triple(block, "vn ", normal);
        block.push_back('\n');
    }
    for (const Face& face : mesh.faces) {
        fmt::memory_buffer& block = writer.block();
        block.push_back('f');
        for (const std::uint32_t vertex : face) {
            put_corner(block, vertex, !mesh.normals.empty());
        }
        block.push_back('\n');
    }
}

void write_off(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const Eigen::Vector3d shift = mesh.offset - format.offset;
    BlockWriter writer(out);
    fmt::format_to(fmt::appender(writer.block()), "{}\n{} {} 0\n",
                   mesh.colors.empty() ? "OFF" : "COFF", mesh.positions.size(), mesh.faces.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        fmt::memory_buffer& block = writer.block();
        const Eigen::Vector3d position = mesh.positions[v] + shift;
        put_triple(block, "", position);
        if (!mesh.colors.empty()) {
            put_color(block, mesh.colors[v]);
            fmt::format_to(fmt::appender(block), " 1.0000"); // opaque
        }
        block.push_back('\n');
    }
    for (const Face& face : mesh.faces) {
        fmt::memory_buffer& block = writer.block();
        put_triple(block, "3 ", face);
        block.push_back('\n');
    }
    put_comments(writer.block(), format); // last, because some readers reject comments
}

void write_stl(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const Eigen::Vector3d shift = mesh.offset - format.offset;
    BlockWriter writer(out);
    writer.block().append(header_of(format));
    put_little_endian(writer.block(), static_cast<std::uint32_t>(mesh.faces.size()));
    for (const Face& face : mesh.faces) {
        fmt::memory_buffer& block = writer.block();
        put_floats(block, face_normal(mesh.positions, face));
        for (const std::uint32_t vertex : face) {
            put_floats(block, mesh.positions[vertex] + shift);
        }
        put_little_endian(block, std::uint16_t{0}); // attribute byte count
    }
}

} // namespace vcarve
