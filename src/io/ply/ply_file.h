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

/// The points of a PLY file, in its order. The optional arrays are empty or have one entry a point.
struct PointCloud {
    /// Offset added, but of meshes; what is no place (model/place.h) is not finite.
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3f> normals; ///< optional: as they stand in the file
    std::vector<Color> colors;            ///< optional
    /// Where the scanners stood, offset added: one a point, or one for all of them. Finite, but of
    /// points that are not.
    std::vector<Eigen::Vector3d> scanners;
    std::vector<Splat> splats; ///< optional: of Gaussians
    Tracks images;             ///< optional: the numbers of the images that its list names
};

/// What is read of a PLY file.
enum class PlyContent { points, points_and_scanners, mesh };

/// Reads the vertices of a PLY file part by part, in its order; see read_ply_cloud and read_ply for
/// what is read and refused. The parts of the file that have been read are no longer in memory.
class PlyReader {
  public:
    /// Opens the file, and refuses what its header tells.
    explicit PlyReader(const std::filesystem::path& path, PlyContent content = PlyContent::points);
    PlyReader(const PlyReader&) = delete;
    PlyReader& operator=(const PlyReader&) = delete;

    std::size_t num_points() const { return vertices_.count; }
    const Eigen::Vector3d& offset() const { return header_.offset; }
    /// The next points, at most so many; none after the last. A scanner that stands for all is told
    /// with the last ones.
    PointCloud next(std::size_t most, const Progress& progress = {});
    /// The faces of a mesh, all of whose vertices were read.
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
    bool with_scanners_ = false;         ///< of each vertex
    const PlyElement* camera_ = nullptr; ///< that stands for all vertices; null where none does
    const PlyElement* faces_ = nullptr;  ///< of a mesh
    std::optional<Eigen::Vector3d> place_of_camera_;
    std::vector<Face> read_faces_;
    std::uint64_t done_ = 0; ///< vertices
};

/// Reads the vertices of an ascii, little endian or big endian PLY file, numbers of any type; text
/// is read with all its digits, also where the header calls it float. Other properties and elements
/// before them are skipped; what follows all that is asked for is not read. Throws InputError: no
/// such file, not PLY, cut off, no vertices with x, y and z; where the scanners are asked for and
/// the file has some (see scanners_in), less than three coordinates of them, or one that is no
/// finite number, or not one camera; and Cancelled. Cost: linear in the size of the file, which is
/// mapped, and in parallel where every vertex takes as many bytes, in binary files without lists;
/// allocations never exceed a small multiple of it.
PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress = {},
                          PlyContent content = PlyContent::points);

/// Only the header of a file. Throws InputError. Cost: none.
PlyHeader read_ply_header(const std::filesystem::path& path);

/// Writes what write_ply() does into a stream, whose errors are left to whoever owns it. Where
/// there is a texture, the names are those of its pages' files.
void write_ply(std::ostream& out, const TriMesh& mesh, const MeshFormat& format,
               const std::vector<std::string>& page_names);

} // namespace vcarve
