#pragma once

#include <cstdint>
#include <vector>

namespace vcarve {

/// The origin of the vertices and faces of a TriMesh, in arrays parallel to those of the mesh. A
/// vertex that is no point of the model has point id -1, 0 views and error -1. Such vertices are
/// the centers of filled holes and the midpoints of split edges.
struct Provenance {
    std::vector<std::int64_t> point_ids; ///< per vertex, COLMAP's point3D id
    std::vector<std::int32_t> num_views; ///< per vertex, the number of views of the point
    std::vector<float> errors_px;        ///< per vertex, mean reprojection error; -1 if unknown
    /// Per face, the smallest number of views in front of it that saw a corner; 0 if a corner is no
    /// point of the model.
    std::vector<std::int32_t> supports;
};

} // namespace vcarve
