#include "io/files/block_writer.h"
#include "io/files/output_file.h"
#include "io/ply/ply_file.h"
#include "model/photograph.h"

#include <fmt/format.h>

#include <ostream>

namespace vcarve {
namespace {

/// Appends a number in binary, or as text with a space.
template <typename Number>
void put_one(fmt::memory_buffer& block, Number number, bool binary)
{
    if (binary) {
        put_little_endian(block, number);
    } else {
        fmt::format_to(fmt::appender(block), "{} ", number);
    }
}

/// Appends three numbers in binary or as text.
template <typename Vector>
void put_triple(fmt::memory_buffer& block, const Vector& triple, bool binary)
{
    for (int i = 0; i < 3; ++i) {
        put_one(block, triple[i], binary);
    }
}

/// Replaces the last space of a text line by a line break.
void end_line(fmt::memory_buffer& block, bool binary)
{
    if (!binary) block[block.size() - 1] = '\n';
}

void write_header(std::ostream& out, const TriMesh& mesh, const MeshFormat& format,
                  const std::vector<std::string>& page_names)
{
    out << "ply\nformat " << (format.ascii ? "ascii" : "binary_little_endian") << " 1.0\n";
    for (const std::string& comment : comment_lines(format)) {
        out << "comment " << comment << '\n';
    }
    for (const std::string& name : page_names) {
        out << "comment TextureFile " << name << '\n';
    }
    out << "element vertex " << mesh.positions.size() << '\n'
        << "property double x\nproperty double y\nproperty double z\n";
    if (!mesh.normals.empty()) {
        out << "property float nx\nproperty float ny\nproperty float nz\n";
    }
    if (!mesh.colors.empty()) {
        out << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    if (format.provenance != nullptr) {
        out << "property double point3d_id\nproperty int num_views\nproperty float error_px\n";
    }
    out << "element face " << mesh.faces.size() << '\n'
        << "property list uchar int vertex_indices\n";
    if (format.texture != nullptr) {
        out << "property list uchar float texcoord\nproperty int texnumber\n";
    }
    if (format.provenance != nullptr) {
        out << "element face_support " << mesh.faces.size() << "\nproperty int support\n";
    }
    out << "end_header\n";
}

void put_provenance(fmt::memory_buffer& block, const Provenance& provenance, std::size_t vertex,
                    bool binary)
{
    put_one(block, static_cast<double>(provenance.point_ids[vertex]), binary);
    put_one(block, provenance.num_views[vertex], binary);
    put_one(block, provenance.errors_px[vertex], binary);
}

void write_vertices(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const bool binary = !format.ascii;
    const Eigen::Vector3d shift = mesh.offset - format.offset;
    BlockWriter writer(out);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        fmt::memory_buffer& block = writer.block();
        const Eigen::Vector3d position = mesh.positions[i] + shift;
        put_triple(block, position, binary);
        if (!mesh.normals.empty()) put_triple(block, mesh.normals[i], binary);
        if (!mesh.colors.empty()) put_triple(block, mesh.colors[i], binary);
        if (format.provenance != nullptr) put_provenance(block, *format.provenance, i, binary);
        end_line(block, binary);
    }
}

/// Appends the texture coordinates of a face's corners (v upward) and its page.
void put_places(fmt::memory_buffer& block, const Texture& texture, std::size_t face, bool binary)
{
    put_one(block, std::uint8_t{6}, binary);
    for (const Eigen::Vector2f& place : texture.places[face]) {
        put_one(block, place.x(), binary);
        put_one(block, 1.0F - place.y(), binary);
    }
    put_one(block, static_cast<std::int32_t>(texture.page_of_face[face]), binary);
}

void write_faces(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const bool binary = !format.ascii;
    BlockWriter writer(out);
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        fmt::memory_buffer& block = writer.block();
        put_one(block, std::uint8_t{3}, binary);
        put_triple(block, mesh.faces[i], binary);
        if (format.texture != nullptr) put_places(block, *format.texture, i, binary);
        end_line(block, binary);
    }
}

void write_supports(std::ostream& out, const Provenance& provenance, bool binary)
{
    BlockWriter writer(out);
    for (const std::int32_t support : provenance.supports) {
        fmt::memory_buffer& block = writer.block();
        put_one(block, support, binary);
        end_line(block, binary);
    }
}

} // namespace

void write_ply(std::ostream& out, const TriMesh& mesh, const MeshFormat& format,
               const std::vector<std::string>& page_names)
{
    write_header(out, mesh, format, page_names);
    write_vertices(out, mesh, format);
    write_faces(out, mesh, format);
    if (format.provenance != nullptr) write_supports(out, *format.provenance, !format.ascii);
}

void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const MeshFormat& format)
{
    OutputFile file(path);
    write_ply(file.stream(), mesh, format, {});
    // commit() reports stream errors, because it knows their cause.
    file.commit();
}

} // namespace vcarve
