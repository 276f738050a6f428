#include "steps/5_labels/labelling.h"

#include "base/parallel.h"

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

void Labelling::close_hull()
{
    const auto beyond = parallel_collect<Index>(labels_.size(), [&](std::size_t i, auto& found) {
        if (labels_[i] == Label::inside && cells_->cells[i].is_infinite())
            found.push_back(static_cast<Index>(i));
    });
    set(beyond, Label::outside);
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
