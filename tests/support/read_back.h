#pragma once

#include "vcarve/tri_mesh.h"

#include <filesystem>
#include <vector>

namespace vcarve {

/// A bumpy sheet of 9 x 7 vertices with normals and colours, no two the same; manifold, so that
/// every reader takes it.
TriMesh sample_sheet();

/// What a corner of a face looks like, whichever vertices a reader makes of it.
struct Corner {
    Eigen::Vector3d position;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< zero where there is none
    Color color{};                                    ///< black where there is none
};

/// The corners of all faces in their order; `offset` is added.
std::vector<Corner> corners_of(const TriMesh& mesh);

/// What assimp reads from a file, with the moves of glTF's nodes. Its positions are floats.
TriMesh read_by_assimp(const std::filesystem::path& path);

} // namespace vcarve
