#include "steps/5_labels/strict_carving.h"

#include "base/parallel.h"

#include <algorithm>

namespace vcarve {

Labels carve(const TetMesh& cells, const Crossings& crossings, int min_crossings)
{
    Labels labels(cells.cells.size(), Label::inside);
    parallel_for(labels.size(), [&](std::size_t i) {
        const bool is_redundant =
            std::any_of(crossings[i].begin(), crossings[i].end(), [&](std::uint32_t count) {
                return count >= static_cast<std::uint32_t>(min_crossings);
            });
        if (is_redundant || cells.cells[i].is_infinite()) {
            labels[i] = Label::outside;
        }
    });
    return labels;
}

} // namespace vcarve
