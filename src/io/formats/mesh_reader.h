#pragma once

#include "vcarve/tri_mesh.h"

#include <filesystem>

namespace vcarve {

/// Throws UsageError if the name of a file has another end than those read_mesh() reads.
void require_readable_mesh_name(const std::filesystem::path& path);

/// Reads a triangle mesh from .ply (as read_ply), .obj, .off or .stl, in large or small letters.
/// Polygons become fans of triangles; faces that name a vertex twice are left out. Only positions
/// and faces are read of .obj, .off and .stl; equal corners in .stl are one vertex. Throws
/// InputError if the file is missing, broken or without faces, or has a coordinate that is not
/// finite. Cost: linear in the size of the file.
TriMesh read_mesh(const std::filesystem::path& path);

} // namespace vcarve
