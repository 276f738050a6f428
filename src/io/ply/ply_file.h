#pragma once

#include "base/progress.h"
#include "io/files/mapped_file.h"
#include "io/ply/ply_data.h"
#include "io/ply/ply_vertex.h"
#include "vcarve/io.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// The points of a PLY file, in file order. Optional arrays are empty or have one entry per point.
struct PointCloud {
    /// Include the offset, except in meshes. Invalid positions of clouds (scene_check.h) are NaN.
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3f> normals; ///< optional, unchanged
    std::vector<Color> colors;            ///< optional
    /// Scanner positions with the offset: one per point, or one for all. Finite if the point is.
    std::vector<Eigen::Vector3d> scanners;
    std::vector<Splat> splats; ///< optional: for Gaussians
    Tracks images;             ///< optional: image numbers of each point's list
};

/// The content to read from a PLY file.
enum class PlyContent { points, points_and_scanners, mesh };

/// Reads the vertices of a PLY file in parts, in file order. read_ply_cloud and read_ply document
/// the content and the errors. Parts of the file that were read are released from memory.
class PlyReader {
  public:
    /// Opens the file, and checks its header.
    explicit PlyReader(const std::filesystem::path& path, PlyContent content = PlyContent::points);
    PlyReader(const PlyReader&) = delete;
    PlyReader& operator=(const PlyReader&) = delete;

    std::size_t num_points() const { return vertices_.count; }
    const Eigen::Vector3d& offset() const { return header_.offset; }
    /// Returns the next `most` points, or fewer at the end. The last points come with the scanner
    /// position that applies to all points, if any.
    PointCloud next(std::size_t most, const Progress& progress = {});
    /// Returns the faces of a mesh after all vertices were read.
    std::vector<Face> take_faces() { return std::move(read_faces_); }

  private:
    const PlyElement& find_vertices() const;
    void require_all(const char* who_has, const PlyElement& element, const PlyNames& names) const;
    void require_finite(const PointCloud& cloud) const;
    void pass(const PlyElement& element);
    void read_camera();
    void read_faces();
    void read_face(const PlyProperty& corners);
    std::uint32_t corner(PlyType type);
    void read_parallel(PointCloud& cloud, std::size_t vertex_bytes, const Progress& progress);
    void read_in_order(PointCloud& cloud, const Progress& progress);
    void put(PointCloud& cloud, std::size_t i, const PlyVertex& vertex) const;

    std::filesystem::path path_;
    MappedFile file_;
    PlyHeader header_;
    PlyData data_;
    const PlyElement& vertices_;
    PlyVertexLayout layout_;
    bool with_scanners_ = false;         ///< each vertex has a scanner position
    const PlyElement* camera_ = nullptr; ///< scanner of all vertices, or null
    const PlyElement* faces_ = nullptr;  ///< null for clouds
    std::optional<Eigen::Vector3d> place_of_camera_;
    std::vector<Face> read_faces_;
    std::uint64_t done_ = 0; ///< number of vertices read
};

/// Reads the vertices of an ascii, little endian or big endian PLY file with numbers of any type.
/// Text keeps all digits, even if the header declares float. Skips other properties, and elements
/// before the vertices; does not read elements after the last requested one. Throws InputError if
/// the file is missing, is not PLY, is truncated, or has no vertices with x, y and z. Also throws
/// if scanners are requested and present (see scanners_in), but lack a coordinate, are not finite,
/// or are not exactly one camera. Throws Cancelled. Cost: linear in the size of the file, which is
/// mapped. Binary vertices without lists are read in parallel. Allocations are a small multiple of
/// the file size at most.
PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress = {},
                          PlyContent content = PlyContent::points);

/// Reads only the header of a file. Throws InputError. Cost: negligible.
PlyHeader read_ply_header(const std::filesystem::path& path);

/// Writes a mesh like write_ply(), but to a stream; the caller must check it for errors.
/// `page_names` are the file names of the texture pages.
void write_ply(std::ostream& out, const TriMesh& mesh, const MeshFormat& format,
               const std::vector<std::string>& page_names);

} // namespace vcarve
