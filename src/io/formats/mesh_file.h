#pragma once

#include "vcarve/io.h"

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace vcarve {

/// Whether the name of a file ends as one that write_mesh() writes.
bool is_mesh_name(const std::filesystem::path& path);

/// Throws UsageError, naming the ends there are, where it does not.
void require_mesh_name(const std::filesystem::path& path);

/// Throws UsageError where such a file is no PLY file, which `option` is for.
void require_ply(const std::filesystem::path& path, const char* option);

/// Of the JPEG files that textures are written as, from 1 to 100.
inline constexpr int kTextureQuality = 92;

/// How far rounding to floats moves the vertices of a surface that write_mesh() writes to `path`,
/// as a share of the diagonal of its box: the largest change of a coordinate, where the format is
/// STL, and zero for all others, which lose nothing that could be seen.
double rounding_share(const std::filesystem::path& path, const TriMesh& mesh,
                      const MeshFormat& format);

/// Writers of the other formats, for write_mesh(), which says what they write. Errors of the stream
/// are left to whoever owns it.
void write_obj(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_off(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_stl(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_glb(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);

/// Throws UsageError where the numbers of a surface take more bytes than binary glTF holds.
void require_glb_room(std::uint64_t bytes);

} // namespace vcarve
