#pragma once

#include "vcarve/tri_mesh.h"

#include <filesystem>
#include <vector>

namespace vcarve {

/// A bumpy surface of 9 x 7 vertices, all with different normals and colors. It is manifold, so
/// every reader accepts it.
TriMesh sample_sheet();

/// The attributes of a face corner, independent of how a reader splits or merges vertices.
struct Corner {
    Eigen::Vector3d position;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< zero if missing
    Color color{};                                    ///< black if missing
};

/// The corners of all faces in order; `offset` is added.
std::vector<Corner> corners_of(const TriMesh& mesh);

/// The mesh that assimp reads from a file, with the transforms of glTF nodes applied. Positions
/// have the precision of floats.
TriMesh read_by_assimp(const std::filesystem::path& path);

} // namespace vcarve
