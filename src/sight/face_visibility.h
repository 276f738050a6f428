#pragma once

#include "model/labels.h"
#include "model/scene.h"
#include "model/tet_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// What the views see of the boundary between inside and outside cells. A view sees a place on a
/// boundary facet if its image shows the place, the facet turns its front, the outside, to the
/// view, by more than a graze, and the way between them leads through outside cells only. Facets
/// are given from their inside cells. Safe from many threads. Keeps references.
class FaceVisibility {
  public:
    static constexpr int kPlaces = 7;
    using Places = std::array<Eigen::Vector3d, kPlaces>;

    /// What a line meets.
    enum class Meets { nothing, front, back };

    FaceVisibility(const TetMesh& cells, const Labels& labels, const Scene& scene);

    /// Places spread over a facet: its middle, and near its corners and the middles of its edges.
    Places places_on(const CellFacet& facet) const;

    /// Cost: a walk through the cells up to the view, where the view stands before the facet and
    /// its image shows the place.
    bool sees(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place) const;

    /// Whether some view sees one of the places on a facet. The views that saw its corners are
    /// asked first. Cost: where no view sees it, kPlaces walks a view that stands before it.
    bool is_seen(const CellFacet& facet) const;

    /// What a view that sees a place on a facet would meet, were the facet away: the first facet
    /// behind the place that is_kept(facet) says is there, from its front or from its back.
    template <typename IsKept>
    Meets met_behind(std::uint32_t view, const CellFacet& facet, const Eigen::Vector3d& place,
                     const IsKept& is_kept) const;

  private:
    /// A facet of the boundary, given from its inside cell, and from which side a line meets it.
    struct Crossed {
        CellFacet facet;
        Meets side;
    };

    /// What the line from a view through a place on a facet crosses behind it, in order.
    std::vector<Crossed> boundary_behind(std::uint32_t view, const CellFacet& facet,
                                         const Eigen::Vector3d& place) const;

    const TetMesh& cells_;
    const Labels& labels_;
    const Scene& scene_;
    double reach_ = 0.0; ///< longer than any line within the hull
};

template <typename IsKept>
FaceVisibility::Meets FaceVisibility::met_behind(std::uint32_t view, const CellFacet& facet,
                                                 const Eigen::Vector3d& place,
                                                 const IsKept& is_kept) const
{
    for (const Crossed& crossed : boundary_behind(view, facet, place)) {
        if (is_kept(crossed.facet)) return crossed.side;
    }
    return Meets::nothing;
}

} // namespace vcarve
