#pragma once

#include "base/arrays.h"
#include "photo_refine/vertex_moves.h"

#include <span>

namespace vcarve {

/// Where three groups of photographs want a vertex.
struct GroupShifts {
    WantedShift all;
    WantedShift even; ///< of pairs that have no photograph in common with those of `odd`
    WantedShift odd;
};

/// The wanted shifts, with lower weights where the photographs cannot be trusted: where two halves
/// of them want different shifts (by the square of the mean squared difference over eight rings of
/// vertices), and where there is little texture. Without trust, the weight is 0. Cost: O(vertices),
/// in parallel.
std::vector<WantedShift> trusted_shifts(std::span<const GroupShifts> shifts,
                                        const RowTable& neighbors);

} // namespace vcarve
