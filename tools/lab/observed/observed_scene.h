#pragma once

#include "render/parts.h"
#include "render/raster.h"

#include <cstddef>
#include <string>
#include <vector>

namespace vcarve::observed {

/// What a fixture is made of. The contrast of a part's paint says how many features a matcher finds
/// on it, relative to other parts of the same area: none where it is 0.
struct ObservedScene {
    std::string name; ///< of the fixture's folder
    render::Parts parts;
    std::vector<render::Pinhole> views; ///< all of one lens
    std::size_t points = 0;             ///< of the model, outliers included
};

/// Hills with houses, trees and a wall, seen from straight above and askew. Most walls are plain.
ObservedScene from_the_air();

/// A furnished room seen from within. Walls and ceiling are plain.
ObservedScene inside_a_room();

} // namespace vcarve::observed
