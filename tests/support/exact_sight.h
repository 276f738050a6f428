#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/exact_walk.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace vcarve {

/// Where a sight passes a facet.
struct SightCrossing {
    CellFacet facet;
    double share; ///< of the way from the vertex to the target, 0 to 1
};

/// The facets that the segment from a vertex to a target crosses, found by trying every facet of
/// every cell with exact predicates and sorted along the segment in exact arithmetic. A facet is
/// crossed where the vertex lies strictly on its one side, the target strictly on the other, and
/// the line passes through its relative interior.
std::vector<SightCrossing> crossings_by_brute_force(const TetMesh& mesh, Index vertex,
                                                    const Eigen::Vector3d& target);

/// The same for the way from a place in a facet, out of the facet's cell: that facet first, then
/// those that the line crosses behind it, the target strictly beyond. None if the line does not
/// lead out of the cell through the facet's relative interior.
std::vector<CellFacet> crossings_by_brute_force(const TetMesh& mesh, const CellFacet& facet,
                                                const Eigen::Vector3d& place,
                                                const Eigen::Vector3d& target);

/// The finite cell at a vertex whose interior the way to the target enters first; kInfinite if it
/// enters none. Found by trying every cell.
Index first_cell_by_brute_force(const TetMesh& mesh, Index vertex, const Eigen::Vector3d& target);

/// Whether a finite cell holds a point, its border included.
bool holds(const TetMesh& mesh, Index cell, const Eigen::Vector3d& point);

/// Whether a point lies strictly outside the convex hull.
bool is_outside_hull(const TetMesh& mesh, const Eigen::Vector3d& point);

/// What is wrong with a walk from a vertex to a target that said to have crossed `crossed` and to
/// have ended like `ends`, compared to brute force; empty if nothing is.
std::string fault_of_walk(const TetMesh& mesh, Index vertex, const Eigen::Vector3d& target,
                          const std::vector<CellFacet>& crossed, const WalkEnds& ends);

} // namespace vcarve
