#pragma once

#include "render/parts.h"

#include <cstdint>

namespace vcarve::render {

/// A heap of boxes, columns and balls of many sizes, each turned at random and let down on what
/// lies below until it touches. Stands on z = 0 around the origin.
struct Heap {
    int things = 40;
    double spread = 0.4;   ///< standard deviation of their places along x and y
    double smallest = 0.1; ///< sizes are spread evenly in their logarithm
    double largest = 0.5;
    std::uint32_t seed = 1;
};
void add_heap(PartBuilder& builder, const Heap& heap);

} // namespace vcarve::render
