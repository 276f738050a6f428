#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

namespace vcarve {

/// The alpha shape as a solid (Edelsbrunner, Mücke 1994): inside are the cells whose circumsphere
/// has a radius of at most `alpha`. A baseline: it knows the points only and nothing of the views.
/// Where the solid is thinner than its points are dense, or gaps are narrower, no alpha is right.
/// Cost: O(cells).
Labels alpha_shape(const TetMesh& cells, double alpha);

/// The smallest alpha whose alpha shape has every point as the corner of an inside cell and is one
/// piece of cells that hang together through facets. Where flat cells keep every alpha from that:
/// infinity, whose alpha shape is the convex hull. Cost: O(cells log cells).
double smallest_whole_alpha(const TetMesh& cells);

/// The sphere through the corners of a cell. In doubles: of a cell that is nearly flat it is rough.
struct Circumsphere {
    Eigen::Vector3d center;
    double radius = 0.0; ///< infinite for infinite and flat cells, whose center is the origin
};

Circumsphere circumsphere(const TetMesh& cells, Index cell);

} // namespace vcarve
