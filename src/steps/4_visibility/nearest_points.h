#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vcarve {

/// The `count` points nearest to a place, the nearest first; of those at one distance the smaller
/// index first. The search goes along the edges of the Delaunay triangulation from the vertex
/// `start`, any one, so no other index is needed: every point but the nearest has a neighbour that
/// is nearer, the one into whose Voronoi cell the way to the place leads first. Cost:
/// O(count log count), and the way from `start`.
std::vector<Index> nearest_points(const TetMesh& mesh, const Eigen::Vector3d& place,
                                  std::size_t count, Index start);

} // namespace vcarve
