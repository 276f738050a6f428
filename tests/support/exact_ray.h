#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/exact_walk.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace vcarve {

/// The crossing of a ray and a facet.
struct RayCrossing {
    CellFacet facet;
    double share; ///< of the distance from the vertex to the target, 0 to 1
};

/// The facets that the segment from a vertex to a target crosses, sorted along the segment. Tries
/// every facet of every cell with exact predicates, and sorts in exact arithmetic. A facet is
/// crossed if vertex and target are strictly on opposite sides and the line passes through its
/// relative interior.
std::vector<RayCrossing> crossings_by_brute_force(const TetMesh& mesh, Index vertex,
                                                  const Eigen::Vector3d& target);

/// The same for a segment from a position in a facet, out of the facet's cell. The result is this
/// facet and the facets behind it that are strictly before the target. It is empty if the line
/// does not leave the cell through the facet's relative interior.
std::vector<CellFacet> crossings_by_brute_force(const TetMesh& mesh, const CellFacet& facet,
                                                const Eigen::Vector3d& place,
                                                const Eigen::Vector3d& target);

/// The finite cell at a vertex whose interior the segment to the target enters first; kInfinite if
/// it enters none. Tries every cell.
Index first_cell_by_brute_force(const TetMesh& mesh, Index vertex, const Eigen::Vector3d& target);

/// Whether a finite cell contains a point, including its border.
bool holds(const TetMesh& mesh, Index cell, const Eigen::Vector3d& point);

/// Whether a point lies strictly outside the convex hull.
bool is_outside_hull(const TetMesh& mesh, const Eigen::Vector3d& point);

/// Compares a walk from a vertex to a target, which reported `crossed` and `ends`, with brute
/// force. Describes the first difference; empty if they agree.
std::string fault_of_walk(const TetMesh& mesh, Index vertex, const Eigen::Vector3d& target,
                          const std::vector<CellFacet>& crossed, const WalkEnds& ends);

} // namespace vcarve
