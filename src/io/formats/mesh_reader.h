#pragma once

#include "vcarve/tri_mesh.h"

#include <filesystem>

namespace vcarve {

/// Throws UsageError if read_mesh() does not support the file extension.
void require_readable_mesh_name(const std::filesystem::path& path);

/// Reads a triangle mesh from .ply (like read_ply), .obj, .off or .stl, in lower or upper case.
/// Polygons become triangle fans. Faces that use a vertex twice are dropped. Only positions and
/// faces are read from .obj, .off and .stl. Equal corners in .stl become one vertex. Throws
/// InputError if the file is missing, broken or without faces, or if a coordinate is not finite.
/// Cost: linear in the file size.
TriMesh read_mesh(const std::filesystem::path& path);

} // namespace vcarve
