#pragma once

#include "io/work/kept_fields.h"
#include "steps/3_cells/block_cells.h"

namespace vcarve {

template <>
struct KeptFields<BlockCells> {
    static void visit(const auto& field, auto& block)
    {
        field(block.cells);
        field(block.open_facets);
        field(block.taken_in);
    }
};

} // namespace vcarve
