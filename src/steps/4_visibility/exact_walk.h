#pragma once

#include "model/tet_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// The first and the last cell of a walk.
struct WalkEnds {
    /// The cell whose interior the ray enters first; kInfinite if the ray starts along an edge, in
    /// a facet, or out of the hull.
    Index first = kInfinite;
    /// The cell that contains the target, boundary included, or an infinite cell if the ray leaves
    /// the hull; kInfinite if it leaves the hull through an edge or a vertex.
    Index last = kInfinite;
};

/// Follows the segment from a vertex to a target through the cells, with exact predicates only:
/// through facets, along facets and edges, through edges and vertices. The segment crosses a facet
/// if it passes from one side to the other through the relative interior. It crosses nothing where
/// it touches an edge or a vertex, or runs in a facet's plane. Each step advances along the
/// segment, so the walk always ends. Slow and rarely needed: RayWalk uses it when a predicate is 0.
class ExactWalk {
  public:
    ExactWalk(const TetMesh& mesh, const Eigen::Vector3d& point, const Eigen::Vector3d& target)
        : mesh_(mesh), point_(point), target_(target)
    {
    }

    /// Walks from a vertex, which is at `point`, to the target.
    WalkEnds from_vertex(Index vertex);

    /// Continues inside a cell that the segment has entered, and returns the last cell.
    Index from_cell(Index cell);

    /// The facets crossed so far, in order, given from the cells that the segment left by them.
    const std::vector<CellFacet>& crossed() const { return crossed_; }

  private:
    /// The simplex that the ray has reached. `corners` are vertices of `cell`: none inside a cell,
    /// one at a vertex, two on an edge, and three in a facet. In a facet, the corner or edge by
    /// which the ray entered comes first.
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

/// The cells around a vertex, including infinite cells, in no particular order. `start` is one.
std::vector<Index> cells_around_vertex(const TetMesh& mesh, Index vertex, Index start);

} // namespace vcarve
