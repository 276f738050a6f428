#pragma once

#include "model/tri_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// How a mesh is written.
struct PlyFormat {
    bool ascii = false;
    std::vector<std::string> comments; ///< header lines: program version, options, offset
};

/// Writes a surface as PLY through OpenMesh: per vertex x y z (double, `offset` added), nx ny nz (float)
/// and red green blue (uchar) where the mesh has them; per face vertex_indices. The file appears
/// whole or not at all. Throws UsageError where it cannot be written.
void write_ply(const std::filesystem::path& path, const TriMesh& mesh, const PlyFormat& format);

/// Reads a triangle surface; polygons are fanned into triangles, faces are kept as they stand in the file
/// however non-manifold they are. Colours and normals are kept where present. Throws InputError.
TriMesh read_ply(const std::filesystem::path& path);

} // namespace vcarve
