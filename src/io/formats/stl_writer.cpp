#include "geometry/triangle.h"
#include "io/files/block_writer.h"
#include "io/files/comment_lines.h"
#include "io/formats/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

namespace vcarve {
namespace {

constexpr std::size_t kHeaderBytes = 80;

/// Free text, which must not begin with "solid", the first word of an STL file that is text.
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
        put_little_endian(block, std::uint16_t{0}); // what follows a triangle has no meaning
    }
}

} // namespace vcarve
