#pragma once

#include "vcarve/log.h"
#include "vcarve/provenance.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The source of the rays: how the views that saw a point are found.
enum class RaysFrom {
    automatic, ///< file, or nearest if most points of a model have fewer than two views
    file,      ///< the tracks of the model, or the file of stereo_fusion for a cloud
    nearest,   ///< the nearest views with an unobstructed line to the point
};

/// The input points and their rays.
struct PointsOptions {
    /// "sparse" selects the points of the model. "dense" selects fused.ply of the folder, which
    /// stereo_fusion wrote. Any other text is the path of a PLY file with points in the model's
    /// frame. If empty: "dense" if the folder has fused.ply and fused.ply.vis, else "sparse".
    std::string points = {};
    /// The file with the views that saw the points of a PLY file. If empty: the PLY file's path
    /// with .vis appended.
    std::filesystem::path visibility = {};
    RaysFrom rays = RaysFrom::automatic; ///< source of the rays
    /// The position of the laser scanner that measured all points of a PLY file, in the file's
    /// coordinates. It needs no model. If empty, the file may have positions.
    std::optional<Eigen::Vector3d> scanner = {};
};

/// Reads the COLMAP model at `input`, which may be
///
/// - a folder with cameras, images and points3D (.txt, or .bin, which is preferred), or one of
///   these files;
/// - a folder `sparse` of such components, of which the one with most points is read;
/// - a workspace with `sparse/0` or `sparse`;
/// - a dense workspace (fused.ply, fused.ply.vis and sparse), whose dense points are read;
/// - its PLY file, which may have lists of views (OpenMVS's view_indices) instead of a .vis file;
/// - a transforms.json of nerfstudio or instant-ngp: its poses, and the points of its PLY file;
/// - a PLY file with scanner positions, which needs no model. They are x_origin, y_origin and
///   z_origin, or scanner_x, scanner_y and scanner_z, of each vertex. Without a .vis file, view_px,
///   view_py and view_pz of PCL's element `camera` count, too. The views are these positions.
///
/// Views and cameras are sorted by COLMAP's ids, points keep the file order, and Scene::offset is
/// zero. Runs as the stage "read" of `log`, which gets notes about the choice of input. Throws
/// UsageError if options contradict each other. Throws InputError, with file and place, if a file
/// is missing, broken or contradicts another. Throws Cancelled. Cost: linear in the file sizes;
/// allocations are a small multiple of these at most.
Scene read_model(const std::filesystem::path& input, const PointsOptions& options, Log& log);

/// Reads a model with default options.
Scene read_model(const std::filesystem::path& input, Log& log);

struct Texture;

/// Options of the mesh writers.
struct MeshFormat {
    bool ascii = false;                     ///< PLY only: text instead of binary
    std::vector<std::string> comments = {}; ///< written to the file: program version, options
    const Provenance* provenance = nullptr; ///< PLY only: also written unless null
    const Texture* texture = nullptr;       ///< PLY, OBJ and glTF: also written unless null
    /// Subtracted from all written positions. The file records it unless it is zero.
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    Eigen::Vector3d up = Eigen::Vector3d::Zero(); ///< GLB only: becomes y; zero keeps y
};

/// Writes a mesh in the format of the file extension, in lower or upper case. Vertices and faces
/// keep their order; faces may be non-manifold. Positions are in the model's frame (plus
/// TriMesh::offset), minus the offset of `format`.
/// - `.ply`: see write_ply(). `.obj` and `.off` have its comments, too, the latter at the end.
/// - `.obj`: positions with the fewest digits that read back as the same double, then colors from 0
///   to 1 with four decimals, and normals.
/// - `.off`: positions and colors as in `.obj`.
/// - `.stl`: binary, float32 positions. Colors and shared vertices are lost, and comments are cut
///   after 75 bytes.
/// - `.glb`: glTF 2.0 in one file, with normals and 16-bit linear colors, as glTF requires.
///   Positions are float32, relative to the center of the bounding box, and exact to 1e-7 of its
///   size. The node's translation, a double, is this center. The node rotates `up` of `format` to
///   y, which is up in glTF. The asset's extras record `offset` and `up`. At most 4 GiB; a mesh
///   without faces becomes an empty asset.
///
/// The bytes depend only on the arguments. The file appears complete or not at all. Throws
/// UsageError if it cannot be written, the extension is unknown, or an option of `format` is for
/// PLY only. OpenMesh's writers are not used, because they round positions to float in all formats,
/// write no colors into OBJ, and print to global streams.
void write_mesh(const std::filesystem::path& path, const TriMesh& mesh, const MeshFormat& format);

/// Returns an offset for models far from the origin, so that float32 positions have enough digits.
/// It applies to each axis on which the median of the points is farther from zero than ten times
/// their size. There it is the median, rounded to the power of ten above the size. It is zero on
/// other axes. The size is the diagonal of the box without a twentieth of the points at each end.
/// Positions minus the offset keep 1e-6 of the size as float32. Cost: O(points).
Eigen::Vector3d round_offset(const Scene& model);

/// Writes a mesh as PLY. Vertices have x y z (double, as in write_mesh()), and nx ny nz (float) and
/// red green blue (uchar) if the mesh has them. Faces have vertex_indices (uchar, int) and may be
/// non-manifold. The file is binary little endian, or text with the fewest digits that read back as
/// the same number. The bytes depend only on the arguments. The file appears complete or not at
/// all. Throws UsageError if it cannot be written. OpenMesh's writer is not used, because it rounds
/// coordinates to float, writes no comments and rejects non-manifold faces. A second PLY writer in
/// its IOManager would be selected by the order of addresses.
///
/// MeshLab, CloudCompare, Open3D, trimesh, and COLMAP's mesh_simplifier and mesh_texturer read
/// double coordinates (some round them to float) and `vertex_indices`. COLMAP writes
/// `vertex_index`, but reads any list.
///
/// A provenance adds point3d_id (double, exact; PLY has no integer type for all ids), num_views
/// (int) and error_px (float) to the vertices. The support of faces (int) is in a separate element
/// `face_support` after the faces, one entry per face. COLMAP's reader of binary meshes skips
/// unknown vertex properties, but expects faces to have only a list of corners.
void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const MeshFormat& format);

/// Reads a triangle mesh from a PLY file: ascii, little endian or big endian, numbers of any type.
/// Polygons are split into triangle fans. Faces are read unchanged, even if non-manifold. Colors
/// and normals are read if present; other properties and elements are skipped. A comment `offset X
/// Y Z` of the writers becomes TriMesh::offset. Throws InputError if the file is missing, is not
/// PLY, is truncated or has no element `face`, or if a coordinate is not finite, a vertex index is
/// out of range, or a face has fewer than three corners. Cost: linear in the file size; allocations
/// are a small multiple of it at most. OpenMesh's reader is not used, because it rounds coordinates
/// to float and trusts the header's counts.
TriMesh read_ply(const std::filesystem::path& path);

} // namespace vcarve
