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

/// From where it is known which views saw the points.
enum class SightsFrom {
    automatic, ///< as file; where most points of a model have fewer than two views then, as nearest
    file,      ///< from the model's tracks; of a cloud, from the file that stereo_fusion writes
    nearest,   ///< from nowhere: the nearest views are taken before which no other point stands
};

/// Which points are read with the views of a model.
struct PointsOptions {
    /// "sparse": those of the model. "dense": those of fused.ply in the folder, which stereo_fusion
    /// wrote. Else the path of a PLY file with points in the model's frame. Empty: the dense ones
    /// where the folder has fused.ply and fused.ply.vis, the sparse ones where it has not.
    std::string points = {};
    /// Which views saw the points of a PLY file; empty: the file that is called like it and .vis.
    std::filesystem::path visibility = {};
    SightsFrom sights = SightsFrom::automatic; ///< which views saw the points
    /// Where the laser scanner stood that measured all points of a PLY file, in the file's own
    /// coordinates. Needs no model; nothing where the file tells itself.
    std::optional<Eigen::Vector3d> scanner = {};
};

/// Reads the COLMAP model that `input` means: a folder with cameras, images and points3D (.bin or
/// .txt) or one of these files, a `sparse` folder with such components (the one with most points is
/// taken), or a workspace that holds `sparse/0` or `sparse`. Where a folder has both formats, .bin
/// is taken. A dense workspace, which holds fused.ply, fused.ply.vis and sparse, gives its dense
/// points; so does the PLY file itself, whose points may have lists of views instead (OpenMVS's
/// view_indices). A transforms.json of nerfstudio or instant-ngp gives its poses with the points of
/// its PLY file. A PLY file that tells where the scanner of its points stood needs no model: each
/// vertex has x_origin, y_origin and z_origin, or scanner_x, scanner_y and scanner_z; or an element
/// `camera`, as PCL writes it, has view_px, view_py and view_pz, which counts where the file has no
/// .vis beside it. Its views are then the places of the scanners. Runs as the stage "read" of
/// `log`, which also gets a note on what was taken and what not. Views and cameras are sorted by
/// COLMAP's ids, points keep the order of the file, and Scene::offset is zero. Throws UsageError
/// where the options contradict each other, and InputError naming file and place where a file is
/// missing, broken or contradicts another, and Cancelled. Cost: linear in the size of the files;
/// allocations never exceed a small multiple of it.
Scene read_model(const std::filesystem::path& input, const PointsOptions& options, Log& log);

/// The same, of points found by looking.
Scene read_model(const std::filesystem::path& input, Log& log);

struct Texture;

/// How a mesh is written.
struct MeshFormat {
    bool ascii = false;                     ///< PLY only: numbers as text instead of binary
    std::vector<std::string> comments = {}; ///< said in the file: program version, options
    const Provenance* provenance = nullptr; ///< PLY only: written as well where there is one
    const Texture* texture = nullptr; ///< PLY, OBJ and glTF: written as well where there is one
    /// Subtracted from every position that is written, and said in the file unless it is zero.
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    Eigen::Vector3d up = Eigen::Vector3d::Zero(); ///< GLB only: what y is to be there; zero: y
};

/// Writes a surface in the format that the end of the file's name means, in large or small letters.
/// Vertices and faces keep their order, faces are written as they stand, manifold or not, and
/// positions in the frame of the model, which is what TriMesh::offset leads to, minus the offset of
/// `format`.
///
/// - `.ply`: as write_ply() does, and so are comments in `.obj` and, at its end, in `.off`.
/// - `.obj`: positions with the fewest digits that read back as the same double, colours behind
///   them, from 0 to 1 with four decimals, and normals.
/// - `.off`: positions and colours in the same way.
/// - `.stl`: binary, positions as floats; neither colours nor which faces meet. Comments are cut
///   off after 75 bytes.
/// - `.glb`: glTF 2.0 in one file, with normals and colours. Positions are floats relative to the
///   middle of their box, which is the node's translation and a double; so they are right to 1e-7
///   of the box wherever it lies. The offset is the asset's extra `offset`. Colours are linear with
///   16 bits, as glTF wants them. glTF takes y to point up: the node turns the way that `up` of
///   `format` points there, which is the asset's extra `up`. No more than 4 GiB; a surface without
///   faces is an empty asset.
///
/// The bytes depend on the arguments alone. The file appears whole or not at all. Throws UsageError
/// where it cannot be written, its name ends otherwise, or `format` asks for what is for PLY only.
/// OpenMesh's writers are not used: they round positions to floats in all these formats, write no
/// colours into OBJ, and print through streams that are global.
void write_mesh(const std::filesystem::path& path, const TriMesh& mesh, const MeshFormat& format);

/// Where positions of a model far from the origin are written with digits to spare for float: along
/// each axis on which the median of its points lies more than ten times their size from zero, that
/// median, rounded to the power of ten next above the size; zero along the others. The size is the
/// diagonal of a box that leaves out a twentieth at each end. What is left keeps 1e-6 of the size
/// as a float. Cost: O(points).
Eigen::Vector3d round_offset(const Scene& model);

/// Writes a surface as PLY: per vertex x y z (double, as write_mesh() says), nx ny nz (float) and
/// red green blue (uchar) where the mesh has them; per face vertex_indices (uchar, int). Binary
/// little endian, or ascii with the fewest digits that read back as the same number. Faces are
/// written as they stand, manifold or not. The bytes depend on the arguments alone. The file
/// appears whole or not at all. Throws UsageError where it cannot be written. OpenMesh's own writer
/// is not used because it rounds coordinates to float, writes no comments and takes no faces that
/// are not manifold; a writer of ours behind its IOManager would be found or not by the order of
/// addresses, since two would then write PLY.
///
/// Why so: MeshLab, CloudCompare, Open3D, trimesh and COLMAP's mesh_simplifier and mesh_texturer
/// take double coordinates (some round them to float themselves, which is then their loss and not
/// the file's), and all of them know `vertex_indices`; COLMAP writes `vertex_index` but takes any
/// list of a face.
///
/// A provenance adds point3d_id (double, since PLY has no whole number that holds all ids; exact),
/// num_views (int) and error_px (float) to the vertices. The faces' support (int) is an element
/// `face_support` of its own behind the faces, one entry a face: COLMAP's reader of binary meshes
/// skips what it does not know of a vertex, but takes a face to be its list of corners only.
void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const MeshFormat& format);

/// Reads a triangle surface from ascii, little endian or big endian PLY, numbers of any type.
/// Polygons are fanned into triangles, faces are kept as they stand in the file however
/// non-manifold they are; colours and normals are kept where present, other properties and elements
/// are skipped. A comment `offset X Y Z`, as the writers leave it, becomes TriMesh::offset. Throws
/// InputError: no such file, not PLY, cut off, no faces element, a coordinate that is no finite
/// number, a vertex index out of range, a face of fewer than three corners. Cost: linear in the
/// size of the file; allocations never exceed a small multiple of it. OpenMesh's own reader is not
/// used because it rounds coordinates to float and trusts the header's counts.
TriMesh read_ply(const std::filesystem::path& path);

} // namespace vcarve
