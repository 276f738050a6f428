#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Stands for the point of a vertex that is none.
inline constexpr std::uint32_t kNoPoint = 0xffffffffU;

using Face = std::array<std::uint32_t, 3>; ///< vertex indices, counter-clockwise seen from outside

/// A triangle surface. The optional arrays are empty or have one entry a vertex.
struct TriMesh {
    std::vector<Eigen::Vector3d> positions; ///< in world minus `offset`
    std::vector<Face> faces;                ///< manifold or not
    std::vector<Color> colors;              ///< optional
    std::vector<Eigen::Vector3f> normals;   ///< optional, unit, pointing outside
    std::vector<std::uint32_t> points; ///< optional: the scene's point a vertex was, or kNoPoint
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< add to a position to get the model's
};

} // namespace vcarve
