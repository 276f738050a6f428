#pragma once

#include <cstdint>
#include <vector>

namespace vcarve {

/// What the vertices and faces of a TriMesh come from, in arrays parallel to its own. A vertex that
/// is no point of the model (the middle of a filled hole or of a split edge) has point id -1,
/// 0 views and error -1.
struct Provenance {
    std::vector<std::int64_t> point_ids; ///< per vertex, COLMAP's point3D id
    std::vector<std::int32_t> num_views; ///< per vertex, how many views saw the point
    std::vector<float> errors_px;        ///< per vertex, mean reprojection error; -1 where unknown
    /// Per face, how many views saw its least seen corner from the front of the face; 0 where one
    /// of the corners is no point of the model.
    std::vector<std::int32_t> supports;
};

} // namespace vcarve
