#pragma once

#include "model/labels.h"
#include "model/scene.h"
#include "model/tet_mesh.h"
#include "surface/boundary.h"
#include "surface/union_find.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// How plausible a face of a boundary is, from 0 to 1: its chance to be right, as measured on
/// scenes whose geometry is known. Small faces and those that go on with the surface around them
/// mostly are; long ones that stand across it are right every other time (docs/quality.md).
double plausibility(const Boundary& boundary, std::size_t face);

/// The cells inside before and outside after, in pieces joined through facets, and what became of
/// each: a piece takes away the faces it had with the outside before, and lays others open. Each
/// face counts by its area times its plausibility: by half of that where its corners were not seen
/// from its front, and by minus half its area where they were seen from its back instead, like the
/// underside of a roof, so that it speaks against a piece that lays it open. Asked for one boundary
/// after the other, so that only one of them need be held. Keeps references. Cost: O(faces + freed
/// cells) a question, in parallel but for the sums.
class FreedPieces {
  public:
    FreedPieces(const TetMesh& cells, const Scene& scene, const Labels& before,
                const Labels& after);

    bool empty() const { return freed_.empty(); }

    /// Charges the pieces with the faces they took from the boundary before.
    void take_away(const Boundary& boundary_before);
    /// Credits the pieces with the faces they lay open in the boundary after.
    void lay_open(const Boundary& boundary_after);

    /// The cells, ascending, of the pieces that do not pay: that lay open less than nine tenths of
    /// what they take away.
    std::vector<Index> unpaid();

  private:
    template <typename FreedCell>
    void add_worths(const Boundary& boundary, double sign, const FreedCell& freed_cell);
    std::uint32_t number_of(Index cell) const;

    const TetMesh& cells_;
    const Scene& scene_;
    const Labels& before_;
    const Labels& after_;
    std::vector<Index> freed_;  ///< ascending
    UnionFind pieces_;          ///< of the freed cells, by their places in `freed_`
    std::vector<double> gains_; ///< of pieces, at the places of their first cells
};

} // namespace vcarve
