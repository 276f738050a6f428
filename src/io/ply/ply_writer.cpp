#include "base/error.h"
#include "io/files/output_file.h"
#include "io/ply/ply.h"

#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/IO/writer/BaseWriter.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

namespace vcarve {
namespace {

using OpenMesh::IO::BaseExporter;
using OpenMesh::IO::Options;

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using EmptyMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Shows a TriMesh to OpenMesh's writer modules. No half-edge mesh stands behind it, because that
/// could not hold non-manifold faces and would cost more than the writing; what is not overridden
/// answers for an empty mesh.
class TriMeshExporter : public OpenMesh::IO::ExporterT<EmptyMesh> {
  public:
    explicit TriMeshExporter(const TriMesh& mesh) : ExporterT(empty_), mesh_(mesh) {}

    std::size_t n_vertices() const override { return mesh_.positions.size(); }
    std::size_t n_faces() const override { return mesh_.faces.size(); }
    bool has_vertex_normals() const override { return !mesh_.normals.empty(); }
    bool has_vertex_colors() const override { return !mesh_.colors.empty(); }

    OpenMesh::Vec3d pointd(OpenMesh::VertexHandle vertex) const override
    {
        const Eigen::Vector3d p = mesh_.positions[index(vertex)] + mesh_.offset;
        return {p.x(), p.y(), p.z()};
    }
    OpenMesh::Vec3f normal(OpenMesh::VertexHandle vertex) const override
    {
        const Eigen::Vector3f& n = mesh_.normals[index(vertex)];
        return {n.x(), n.y(), n.z()};
    }
    OpenMesh::Vec3uc color(OpenMesh::VertexHandle vertex) const override
    {
        const Color& c = mesh_.colors[index(vertex)];
        return {c[0], c[1], c[2]};
    }
    unsigned int get_vhandles(OpenMesh::FaceHandle face,
                              std::vector<OpenMesh::VertexHandle>& vertices) const override
    {
        vertices.clear();
        for (const std::uint32_t v : mesh_.faces[static_cast<std::size_t>(face.idx())]) {
            vertices.emplace_back(static_cast<int>(v));
        }
        return 3;
    }

  private:
    static std::size_t index(OpenMesh::VertexHandle vertex)
    {
        return static_cast<std::size_t>(vertex.idx());
    }

    EmptyMesh empty_;
    const TriMesh& mesh_;
};

/// Gathers bytes and hands them to the stream in large blocks.
class BlockWriter {
  public:
    explicit BlockWriter(std::ostream& out) : out_(out) {}
    ~BlockWriter() { out_.write(block_.data(), static_cast<std::streamsize>(block_.size())); }
    BlockWriter(const BlockWriter&) = delete;
    BlockWriter& operator=(const BlockWriter&) = delete;

    fmt::memory_buffer& block()
    {
        if (block_.size() > kBlockBytes) {
            out_.write(block_.data(), static_cast<std::streamsize>(block_.size()));
            block_.clear();
        }
        return block_;
    }

  private:
    static constexpr std::size_t kBlockBytes = 1 << 20;

    std::ostream& out_;
    fmt::memory_buffer block_;
};

template <typename Number>
void put_little_endian(fmt::memory_buffer& block, Number number)
{
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    block.append(bytes.data(), bytes.data() + bytes.size());
}

/// One number, by memory layout or as text.
template <typename Number>
void put_one(fmt::memory_buffer& block, Number number, bool binary)
{
    if (binary) {
        put_little_endian(block, number);
    } else {
        fmt::format_to(fmt::appender(block), "{} ", number);
    }
}

/// Three numbers of a vertex, by memory layout or as text.
template <typename Vector>
void put_triple(fmt::memory_buffer& block, const Vector& triple, bool binary)
{
    for (int i = 0; i < 3; ++i) {
        put_one(block, triple[i], binary);
    }
}

/// The last blank of a line of text becomes its end.
void end_line(fmt::memory_buffer& block, bool binary)
{
    if (!binary) block[block.size() - 1] = '\n';
}

/// OpenMesh IO module for PLY with double coordinates and comments, neither of which OpenMesh's own
/// module writes. It is called directly rather than through OpenMesh's IOManager: that one is a
/// global, never lets a module go, and picks between two modules for one extension by their
/// addresses.
class PlyModule : public OpenMesh::IO::BaseWriter {
  public:
    explicit PlyModule(const PlyFormat& format) : format_(format) {}

    std::string get_description() const override { return "PLY with double coordinates"; }
    std::string get_extensions() const override { return "ply"; }

    bool write(const std::string& name, BaseExporter& source, Options options,
               std::streamsize precision) const override
    {
        std::ofstream out(name, std::ios::binary);
        return write(out, source, options, precision);
    }
    bool write(std::ostream& out, BaseExporter& source, Options options,
               std::streamsize /*precision*/) const override
    {
        if (!check(source, options)) return false;
        write_header(out, source, options);
        write_vertices(out, source, options);
        write_faces(out, source, options);
        if (format_.provenance != nullptr) write_supports(out, *format_.provenance, options);
        return out.good();
    }

  private:
    void write_header(std::ostream& out, const BaseExporter& source, const Options& options) const;
    void write_vertices(std::ostream& out, const BaseExporter& source,
                        const Options& options) const;
    static void write_faces(std::ostream& out, const BaseExporter& source, const Options& options);
    static void write_supports(std::ostream& out, const Provenance& provenance,
                               const Options& options);

    const PlyFormat& format_;
};

/// A comment is one line: what would break it becomes a blank.
std::string one_line(std::string text)
{
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

void PlyModule::write_header(std::ostream& out, const BaseExporter& source,
                             const Options& options) const
{
    out << "ply\nformat " << (options.is_binary() ? "binary_little_endian" : "ascii") << " 1.0\n";
    for (const std::string& comment : format_.comments) {
        out << "comment " << one_line(comment) << '\n';
    }
    out << "element vertex " << source.n_vertices() << '\n'
        << "property double x\nproperty double y\nproperty double z\n";
    if (options.vertex_has_normal()) {
        out << "property float nx\nproperty float ny\nproperty float nz\n";
    }
    if (options.vertex_has_color()) {
        out << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    if (format_.provenance != nullptr) {
        out << "property double point3d_id\nproperty int num_views\nproperty float error_px\n";
    }
    out << "element face " << source.n_faces() << '\n'
        << "property list uchar int vertex_indices\n";
    if (format_.provenance != nullptr) {
        out << "element face_support " << source.n_faces() << "\nproperty int support\n";
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

void PlyModule::write_vertices(std::ostream& out, const BaseExporter& source,
                               const Options& options) const
{
    BlockWriter writer(out);
    for (std::size_t i = 0; i < source.n_vertices(); ++i) {
        fmt::memory_buffer& block = writer.block();
        const OpenMesh::VertexHandle vertex(static_cast<int>(i));
        put_triple(block, source.pointd(vertex), options.is_binary());
        if (options.vertex_has_normal()) {
            put_triple(block, source.normal(vertex), options.is_binary());
        }
        if (options.vertex_has_color()) {
            put_triple(block, source.color(vertex), options.is_binary());
        }
        if (format_.provenance != nullptr) {
            put_provenance(block, *format_.provenance, i, options.is_binary());
        }
        end_line(block, options.is_binary());
    }
}

void PlyModule::write_faces(std::ostream& out, const BaseExporter& source, const Options& options)
{
    BlockWriter writer(out);
    std::vector<OpenMesh::VertexHandle> corners;
    for (std::size_t i = 0; i < source.n_faces(); ++i) {
        fmt::memory_buffer& block = writer.block();
        source.get_vhandles(OpenMesh::FaceHandle(static_cast<int>(i)), corners);
        const std::array<std::int32_t, 3> triple{corners[0].idx(), corners[1].idx(),
                                                 corners[2].idx()};
        constexpr std::string_view kThree = "3 ";
        options.is_binary() ? block.push_back(3) : block.append(kThree);
        put_triple(block, triple, options.is_binary());
        end_line(block, options.is_binary());
    }
}

void PlyModule::write_supports(std::ostream& out, const Provenance& provenance,
                               const Options& options)
{
    BlockWriter writer(out);
    for (const std::int32_t support : provenance.supports) {
        fmt::memory_buffer& block = writer.block();
        put_one(block, support, options.is_binary());
        end_line(block, options.is_binary());
    }
}

} // namespace

void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const PlyFormat& format)
{
    OutputFile file(path);
    TriMeshExporter source(mesh);
    Options options;
    if (!format.ascii) options += Options::Binary;
    if (source.has_vertex_normals()) options += Options::VertexNormal;
    if (source.has_vertex_colors()) options += Options::VertexColor;
    // Errors of the stream are told by commit, which knows their cause.
    PlyModule(format).write(file.stream(), source, options, 0);
    file.commit();
}

} // namespace vcarve
