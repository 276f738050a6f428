#pragma once

#include "model/labels.h"
#include "model/tet_mesh.h"
#include "steps/5_labels/boundary.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace vcarve {

/// Labels of all cells together with their boundary, which is extracted once however many passes
/// ask for it, and updated where labels change. `cells` must outlive it. Not safe from several
/// threads at a time. Memory: a byte a cell, and the boundary from when it was first asked for.
class Labelling {
  public:
    Labelling(const TetMesh& cells, Labels labels);

    const TetMesh& cells() const { return *cells_; }
    const Labels& labels() const { return labels_; }
    std::int64_t num_inside() const;

    /// The boundary and how it runs. Cost: O(cells) the first time.
    const Boundary& boundary();
    /// The facets of the boundary alone. Cost: O(cells) where the boundary is not at hand.
    std::vector<CellFacet> facets() const;

    /// Gives some cells a label. Cost: where the boundary is at hand, that of Boundary::update, so
    /// that few cells at a time are meant.
    void set(std::span<const Index> some_cells, Label label);
    /// Calls all infinite cells outside, so that the boundary is closed. Cost: O(cells).
    void close_hull();
    /// Frees the memory of the boundary.
    void forget_boundary() { boundary_.reset(); }

  private:
    const TetMesh* cells_;
    Labels labels_;
    std::unique_ptr<Boundary> boundary_; ///< of labels_; null where nobody asked for it
};

} // namespace vcarve
