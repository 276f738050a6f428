#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

namespace vcarve {

/// The alpha shape as a solid (Edelsbrunner, Mücke 1994): cells are inside if the radius of their
/// circumsphere is at most `alpha`. A baseline that uses the points only. No alpha is right if the
/// solid or its gaps are thinner than the point spacing. Cost: O(cells).
Labels alpha_shape(const TetMesh& cells, double alpha);

/// The smallest alpha whose alpha shape is whole: every point is a corner of an inside cell, and
/// inside cells are connected through facets. Infinity (the convex hull) if flat cells prevent that
/// for every finite alpha. Cost: O(cells log cells).
double smallest_whole_alpha(const TetMesh& cells);

/// The sphere through the corners of a cell, in doubles; inaccurate for nearly flat cells.
struct Circumsphere {
    Eigen::Vector3d center;
    double radius = 0.0; ///< infinite for infinite and flat cells, whose center is the origin
};

Circumsphere circumsphere(const TetMesh& cells, Index cell);

} // namespace vcarve
