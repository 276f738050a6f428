#pragma once

#include "vcarve/error.h"

#include <cstddef>
#include <stdexcept>

namespace vcarve {

/// Throws InputError where so few points are left that they have no tetrahedron.
void require_four_points(std::size_t num_points);

/// What is thrown where the points do not span space.
InputError all_in_one_plane(std::size_t num_points);

/// What is thrown where the points have more cells than the memory that is allowed holds.
InputError too_many_cells(std::size_t most);

/// What is thrown where two points are the same, which no caller must let happen.
std::logic_error two_at_one_place();

} // namespace vcarve
