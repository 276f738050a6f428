#pragma once

#include "model/photograph.h"
#include "vcarve/io.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vcarve {

/// A textured surface in which every vertex has one place in one page, as formats want it whose
/// corners share vertices: where charts meet there are several vertices in one place. Vertices and
/// faces go page by page, and else keep their order.
struct UnwrappedMesh {
    TriMesh mesh;                        ///< without colours, which would darken the texture
    std::vector<Eigen::Vector2f> places; ///< of the vertices in their page, see Texture
    std::vector<std::size_t> begins{0};  ///< page i has the faces begins[i] up to begins[i + 1]
};

/// Cost: O(faces log(faces)).
UnwrappedMesh unwrap(const TriMesh& mesh, const Texture& texture);

/// The file that a page of a texture is written to, beside the surface: OUT_0.jpg beside OUT.obj.
std::filesystem::path page_path(const std::filesystem::path& surface, std::size_t page);

/// The files that are written beside a surface that has so many pages: the pages, and of OBJ the
/// library of materials, OUT.mtl. None beside glTF, which holds them.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& surface,
                                                std::size_t pages);

/// Writes a surface with `format.texture` as OBJ, and the files beside it; all appear or none.
/// Corners share positions, as `vt` tells where each lies in its page. Throws UsageError where a
/// file cannot be written.
void write_textured_obj(const std::filesystem::path& path, const TriMesh& mesh,
                        const MeshFormat& format);
/// The same as PLY, as MeshLab and COLMAP write and read it: a comment TextureFile a page, and of
/// each face the list texcoord, of its corners u and v upwards, and the number texnumber.
void write_textured_ply(const std::filesystem::path& path, const TriMesh& mesh,
                        const MeshFormat& format);

} // namespace vcarve
