#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// Where a walk began and ended.
struct WalkEnds {
    /// The cell whose interior the sight enters first; kInfinite where it starts along an edge, in
    /// a facet, or out of the hull.
    Index first = kInfinite;
    /// The cell that holds the target, its border included, or an infinite one when the sight
    /// leaves the hull; kInfinite where it leaves the hull through an edge or a vertex.
    Index last = kInfinite;
};

/// Follows the segment from a vertex to a target through the cells by exact predicates alone:
/// through facets, along facets and edges, through edges and vertices. A facet counts as crossed
/// where the segment passes from one side of it to the other through its relative interior;
/// touching an edge or a vertex and running inside a facet's plane cross nothing. Each step goes
/// further along the segment, so the walk always ends. Slow and rarely needed: it takes over where
/// the fast walk meets a zero.
class ExactWalk {
  public:
    ExactWalk(const TetMesh& mesh, const Eigen::Vector3d& point, const Eigen::Vector3d& target)
        : mesh_(mesh), point_(point), target_(target)
    {
    }

    /// From a vertex (at `point`) to the target.
    WalkEnds from_vertex(Index vertex);

    /// On from inside a cell that the segment has entered; returns the last cell.
    Index from_cell(Index cell);

    /// The facets crossed so far, in order, as seen from the cells left.
    const std::vector<CellFacet>& crossed() const { return crossed_; }

  private:
    /// What the sight has reached, and where to look for it. `corners` are vertices of `cell`:
    /// none inside a cell, one at a vertex, two on an edge, three inside a facet (where `entered`
    /// says through which of its corners or edges: the vertex it does not touch is last).
    enum class Kind { end, cell, facet_from_vertex, facet_from_edge, edge, vertex };
    struct Position {
        Kind kind = Kind::end;
        Index cell = kInfinite;
        std::array<Index, 3> corners{};
    };

    Index follow(Position place);
    Position leave(const Position& place);
    Position leave_cell(Index cell);
    Position leave_facet_from_vertex(const Position& place);
    Position leave_facet_from_edge(const Position& place);
    Position leave_edge(const Position& place);
    Position leave_vertex(const Position& place);

    bool target_is_vertex(Index vertex) const { return position(vertex) == target_; }
    const Eigen::Vector3d& position(Index vertex) const { return mesh_.positions[vertex]; }
    int side_of_line(Index a, Index b) const;
    int off_plane_corner(const Position& place) const;

    const TetMesh& mesh_;
    Eigen::Vector3d point_;
    Eigen::Vector3d target_;
    std::vector<CellFacet> crossed_;
};

/// The cells around a vertex, infinite ones included, in no particular order. `start` is one of
/// them.
std::vector<Index> cells_around_vertex(const TetMesh& mesh, Index vertex, Index start);

} // namespace vcarve
