#pragma once

#include "vcarve/io.h"

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace vcarve {

/// Whether write_mesh() supports the file extension.
bool is_mesh_name(const std::filesystem::path& path);

/// Throws UsageError, which lists the supported file extensions, if is_mesh_name() is false.
void require_mesh_name(const std::filesystem::path& path);

/// Throws UsageError if the file extension is not .ply, because `option` is for PLY only.
void require_ply(const std::filesystem::path& path, const char* option);

/// JPEG quality of texture pages, from 1 to 100.
inline constexpr int kTextureQuality = 92;

/// The largest change of a coordinate by rounding to float in write_mesh(), as a fraction of the
/// diagonal of the bounding box. It is zero for formats other than STL, which lose nothing visible.
double rounding_share(const std::filesystem::path& path, const TriMesh& mesh,
                      const MeshFormat& format);

/// Writers of single formats; write_mesh() documents them. The caller must check the stream for
/// errors.
void write_obj(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_off(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_stl(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);
void write_glb(std::ostream& out, const TriMesh& mesh, const MeshFormat& format);

/// Throws UsageError if the numbers of a mesh need more bytes than binary glTF holds.
void require_glb_room(std::uint64_t bytes);

} // namespace vcarve
