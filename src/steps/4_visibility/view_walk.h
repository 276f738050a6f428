#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/walk.h"

#include <Eigen/Core>

#include <optional>

namespace vcarve {

/// Walks through the cells along lines of sight that begin at an eye, wherever it stands: within
/// the hull of the points or out of it. Keeps a reference to the cells.
class ViewWalk {
  public:
    /// Finds where the eye stands by a walk from a vertex to it.
    ViewWalk(const TetMesh& mesh, const Eigen::Vector3d& eye, Index vertex);

    /// Calls goes_on(facet) for every facet that the line from the eye in a direction, a unit
    /// vector, crosses, in order, the facet as seen from the cell before it, until that says no or
    /// the line leaves the hull. Says whether the line could be followed: not where it begins or
    /// enters the hull too close to an edge, nor where the eye lies too close to one to tell where
    /// it stands. A line that passes the hull by is followed and crosses nothing. `reach` is longer
    /// than the way to any point. Cost: as a walk; from out of the hull also a walk over it.
    template <typename GoesOn>
    bool along(const Eigen::Vector3d& direction, double reach, const GoesOn& goes_on) const
    {
        if (cell_ == kInfinite) return false;
        const Eigen::Vector3d target = eye_ + reach * direction;
        const First first = first_facet(SightFrame(eye_, target));
        if (first.facet.cell == kInfinite) return first.is_clear;
        bool is_followed = false;
        SightWalk(mesh_).through_facet(first.facet, place_on(first.facet, direction), target,
                                       [&](const CellFacet& ahead) {
                                           is_followed = true;
                                           return goes_on(ahead);
                                       });
        return is_followed;
    }

  private:
    /// Which facet a line crosses first: of no cell where it crosses none, or it is not clear.
    struct First {
        CellFacet facet{kInfinite, 0};
        bool is_clear = false;
    };

    std::array<int, 3> turns(const SightFrame& frame, const CellFacet& facet) const;
    bool is_before_hull(Index cell) const;
    First first_facet(const SightFrame& frame) const;
    First way_out(const SightFrame& frame) const;
    First way_into_hull(const SightFrame& frame) const;
    Eigen::Vector3d place_on(const CellFacet& facet, const Eigen::Vector3d& direction) const;

    const TetMesh& mesh_;
    Eigen::Vector3d eye_;
    Index cell_; ///< that holds the eye; an infinite one at a facet of the hull that the eye is
                 ///< beyond; kInfinite where that is not known
};

} // namespace vcarve
