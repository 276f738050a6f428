#include "steps/4_labels/labelling.h"

#include <algorithm>
#include <utility>

namespace vcarve {

Labelling::Labelling(const TetMesh& cells, Labels labels)
    : cells_(&cells), labels_(std::move(labels))
{
}

std::int64_t Labelling::num_inside() const
{
    return std::ranges::count(labels_, Label::inside);
}

const Boundary& Labelling::boundary()
{
    if (!boundary_) boundary_ = std::make_unique<Boundary>(*cells_, labels_);
    return *boundary_;
}

std::vector<CellFacet> Labelling::facets() const
{
    return boundary_ ? boundary_->facets_in_order() : boundary_facets(*cells_, labels_);
}

void Labelling::set(std::span<const Index> some_cells, Label label)
{
    if (some_cells.empty()) return;
    for (const Index cell : some_cells) {
        labels_[cell] = label;
    }
    if (boundary_) boundary_->update(labels_, some_cells);
}

} // namespace vcarve
