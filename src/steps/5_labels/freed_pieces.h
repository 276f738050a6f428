#pragma once

#include "base/union_find.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/boundary.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// How plausible a face of a boundary is, from 0 to 1: its chance to be right, as measured on
/// scenes whose geometry is known. Small faces and those that go on with the surface around them
/// mostly are; long ones that stand across it are right every other time (docs/quality.md).
double plausibility(const Boundary& boundary, std::size_t face);

/// The cells inside before and outside after, in pieces joined through facets, and whether each
/// gives the views something better to see: a piece takes away the faces it had with the outside
/// before, and the views that saw them see what lies behind. A face taken away counts by its area
/// times its plausibility. What is seen in its stead counts by the same area times the mean, over
/// four places on the face and the views in the tracks of its corners that see them, of how
/// plausible the first face behind is: half of that where its corners were not seen from its
/// front; minus one half where they were seen from its back instead, like the underside of a roof,
/// or where the back of a face comes to light; 0.3 where nothing lies behind. Faces that none of
/// these views sees count nothing. A piece that leaves a point on no face never pays: that there is
/// something at a point is known better than what is between points. Asked for one boundary after
/// the other, so that one can be made of the other, and the labels before may change in between.
/// Keeps references. Cost: a glance at all cells to find what was freed, then a walk through the
/// cells for every place and view; in parallel.
class FreedPieces {
  public:
    FreedPieces(const TetMesh& cells, const Scene& scene, const Labels& before,
                const Labels& after);

    bool empty() const { return freed_.empty(); }
    /// All of them, ascending.
    const std::vector<Index>& cells() const { return freed_; }

    /// Charges the pieces with the faces they took from the boundary before.
    void take_away(const Boundary& boundary_before);
    /// Credits the pieces with what is seen of the boundary after in their stead. Call it last.
    void lay_open(const Boundary& boundary_after);

    /// The cells, ascending, of the pieces that do not pay: that show less than nine tenths of what
    /// they take away.
    std::vector<Index> unpaid();

  private:
    /// A place on a face that was taken away, and what a view that saw it sees now behind it.
    struct Outlook {
        std::uint32_t freed = 0; ///< the face's cell, by its place among the freed
        FaceVisibility::Crossed met;
        double area = 0.0;  ///< the share of the face's area that this view and place stand for
        double taken = 0.0; ///< times the plausibility of the face
    };

    std::vector<Outlook> outlooks_from(const Boundary& boundary_before, std::size_t face) const;
    double worth(const Boundary& boundary_after, const FaceVisibility::Crossed& met) const;
    bool loses_a_point(Index cell, const Boundary& boundary_before) const;
    void find_losers(const Boundary& boundary_before);
    std::vector<CellFacet> taken_facets();
    std::uint32_t number_of(Index cell) const;

    const TetMesh& cells_;
    const Scene& scene_;
    const Labels& before_; ///< not used by lay_open()
    const Labels& after_;
    std::vector<Index> freed_; ///< ascending
    UnionFind pieces_;         ///< of the freed cells, by their places in `freed_`
    FaceVisibility saw_;       ///< before
    FaceVisibility sees_;      ///< after
    std::vector<Outlook> outlooks_;
    std::vector<double> gains_; ///< of pieces, at the places of their first cells
};

} // namespace vcarve
