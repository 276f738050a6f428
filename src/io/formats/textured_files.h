#pragma once

#include "vcarve/io.h"

#include <filesystem>
#include <vector>

namespace vcarve {

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
