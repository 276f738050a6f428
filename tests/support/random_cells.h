#pragma once

#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>

namespace vcarve::testing {

/// Random points in the unit cube, without views.
Scene random_points(std::size_t count, std::uint64_t seed);

} // namespace vcarve::testing
