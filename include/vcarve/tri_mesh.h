#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The entry of TriMesh::points for a vertex that is no point of the scene.
inline constexpr std::uint32_t kNoPoint = 0xffffffffU;

using Face = std::array<std::uint32_t, 3>; ///< vertex indices, counter-clockwise seen from outside

/// A triangle mesh. The optional arrays are empty or have one entry per vertex.
struct TriMesh {
    std::vector<Eigen::Vector3d> positions; ///< world coordinates minus `offset`
    std::vector<Face> faces;                ///< may be non-manifold
    std::vector<Color> colors;              ///< optional
    std::vector<Eigen::Vector3f> normals;   ///< optional: unit, pointing outside
    std::vector<std::uint32_t> points; ///< optional: the vertex's point in the scene, or kNoPoint
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< add this to a position to get the model's
};

} // namespace vcarve
