#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

namespace vcarve {

/// The sphere through the corners of a cell. In doubles: of a cell that is nearly flat it is rough.
struct Circumsphere {
    Eigen::Vector3d center;
    double radius = 0.0; ///< infinite for infinite and flat cells, whose center is the origin
};

Circumsphere circumsphere(const TetMesh& cells, Index cell);

} // namespace vcarve
