#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/walk.h"

#include <Eigen/Core>

#include <optional>

namespace vcarve {

/// Walks through the cells along rays from an eye, which may be inside or outside the hull of the
/// points. Keeps a reference to the cells.
class ViewWalk {
  public:
    /// Locates the eye by a walk from a vertex.
    ViewWalk(const TetMesh& mesh, const Eigen::Vector3d& eye, Index vertex);

    /// Calls continues(facet) for each facet that the line from the eye in a unit direction
    /// crosses, in order and given from the cell before it. Stops if it returns false or the line
    /// leaves the hull. Returns false if the line cannot be followed: if it starts or enters the
    /// hull too close to an edge, or if the eye is too close to an edge to be located. A line that
    /// misses the hull crosses nothing and returns true. `reach` must exceed the distance to any
    /// point. Cost: a walk; from outside the hull also a walk over it.
    template <typename Continues>
    bool along(const Eigen::Vector3d& direction, double reach, const Continues& continues) const
    {
        if (cell_ == kInfinite) return false;
        const Eigen::Vector3d target = eye_ + reach * direction;
        const First first = first_facet(RayFrame(eye_, target));
        if (first.facet.cell == kInfinite) return first.is_clear;
        bool is_followed = false;
        RayWalk(mesh_).through_facet(first.facet, place_on(first.facet, direction), target,
                                     [&](const CellFacet& ahead) {
                                         is_followed = true;
                                         return continues(ahead);
                                     });
        return is_followed;
    }

  private:
    /// The first facet that a line crosses; its cell is kInfinite if there is none or it is
    /// unclear.
    struct First {
        CellFacet facet{kInfinite, 0};
        bool is_clear = false;
    };

    std::array<int, 3> turns(const RayFrame& frame, const CellFacet& facet) const;
    bool is_before_hull(Index cell) const;
    First first_facet(const RayFrame& frame) const;
    First way_out(const RayFrame& frame) const;
    First way_into_hull(const RayFrame& frame) const;
    Eigen::Vector3d place_on(const CellFacet& facet, const Eigen::Vector3d& direction) const;

    const TetMesh& mesh_;
    Eigen::Vector3d eye_;
    Index cell_; ///< contains the eye; the infinite cell of a hull facet that the eye is outside
                 ///< of; kInfinite if unknown
};

} // namespace vcarve
