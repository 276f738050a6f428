#pragma once

#include "vcarve/log.h"
#include "vcarve/provenance.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// Reads the COLMAP model that `input` means: a folder with cameras, images and points3D (.bin or
/// .txt), a `sparse` folder with such components (the one with most points is taken), or a
/// workspace that holds `sparse/0` or `sparse`. Where a folder has both formats, .bin is taken.
/// Runs as the stage "read" of `log`, which also gets a note on what was not taken. Views and
/// cameras are sorted by COLMAP's ids, points keep the order of the file, and Scene::offset is
/// zero. Throws InputError naming file and place where a file is missing, broken or contradicts
/// another, and Cancelled. Cost: linear in the size of the files; allocations never exceed a small
/// multiple of it.
Scene read_model(const std::filesystem::path& input, Log& log);

/// How a mesh is written.
struct PlyFormat {
    bool ascii = false;                     ///< numbers as text instead of binary
    std::vector<std::string> comments;      ///< header lines: program version, options, offset
    const Provenance* provenance = nullptr; ///< written as well where there is one
};

/// Writes a surface as PLY: per vertex x y z (double, `offset` added), nx ny nz (float) and red
/// green blue (uchar) where the mesh has them; per face vertex_indices (uchar, int). Binary little
/// endian, or ascii with the fewest digits that read back as the same number. Faces are written as
/// they stand, manifold or not. The bytes depend on the arguments alone. The file appears whole or
/// not at all. Throws UsageError where it cannot be written. OpenMesh's own writer is not used
/// because it rounds coordinates to float, writes no comments and takes no faces that are not
/// manifold; a writer of ours behind its IOManager would be found or not by the order of addresses,
/// since two would then write PLY.
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
void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const PlyFormat& format);

/// Reads a triangle surface from ascii, little endian or big endian PLY, numbers of any type.
/// Polygons are fanned into triangles, faces are kept as they stand in the file however
/// non-manifold they are; colours and normals are kept where present, other properties and elements
/// are skipped. Throws InputError: no such file, not PLY, cut off, no faces element, a coordinate
/// that is no finite number, a vertex index out of range, a face of fewer than three corners. Cost:
/// linear in the size of the file; allocations never exceed a small multiple of it. OpenMesh's own
/// reader is not used because it rounds coordinates to float and trusts the header's counts.
TriMesh read_ply(const std::filesystem::path& path);

} // namespace vcarve
