#pragma once

#include "base/unset_array.h"

#include <cstdint>

namespace vcarve {

/// The numbers of points that follow each other in space, in the order that suits insertion: random
/// at large, near each other in the small (Amenta, Choi, Rote, "Incremental constructions con
/// BRIO", 2003).
UnsetArray<std::uint32_t> insertion_order(std::size_t count);

} // namespace vcarve
