#pragma once

#include "model/photograph.h"
#include "vcarve/io.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vcarve {

/// A textured mesh whose vertices have one texture coordinate each, for formats without texture
/// coordinates per corner. Vertices on seams are duplicated. Faces are grouped by page in
/// their order, and vertices are in the order of their first use.
struct UnwrappedMesh {
    TriMesh mesh;                        ///< without colors, because they darken the texture
    std::vector<Eigen::Vector2f> places; ///< texture coordinate per vertex, see Texture
    std::vector<std::size_t> begins{0};  ///< page i has faces begins[i] to begins[i + 1] - 1
};

/// Duplicates the vertices on seams. Cost: O(faces log(faces)).
UnwrappedMesh unwrap(const TriMesh& mesh, const Texture& texture);

/// The path of a texture page, in the mesh's folder: OUT_0.jpg for OUT.obj.
std::filesystem::path page_path(const std::filesystem::path& surface, std::size_t page);

/// The additional files of a mesh with `pages` pages: the pages, and OUT.mtl, the material library,
/// for OBJ. There are none for glTF, because it embeds the pages.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& surface,
                                                std::size_t pages);

/// Writes a mesh with `format.texture` as OBJ, and its additional files. Either all files appear or
/// none. Corners share positions, because `vt` has their texture coordinates. Throws UsageError if
/// a file cannot be written.
void write_textured_obj(const std::filesystem::path& path, const TriMesh& mesh,
                        const MeshFormat& format);
/// Writes the same as PLY, in the layout of MeshLab and COLMAP. Pages have comments TextureFile,
/// faces have a list texcoord (u and v of the corners, v upward) and an integer texnumber.
void write_textured_ply(const std::filesystem::path& path, const TriMesh& mesh,
                        const MeshFormat& format);

} // namespace vcarve
