#pragma once

#include "model/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve::render {

/// The scene behind fixtures/scene: things on a floor before a wall. z is up, units are about a
/// metre.
struct StillLife {
    TriMesh mesh;
    std::vector<std::uint32_t> part_of_face;
    std::vector<Eigen::Array3f> tint_of_part; ///< 0 to 1
};

StillLife still_life();

} // namespace vcarve::render
