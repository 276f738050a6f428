#include "steps/3_cells/refusals.h"

#include <fmt/core.h>

namespace vcarve {

void require_four_points(std::size_t num_points)
{
    if (num_points >= 4) return;
    throw InputError(fmt::format("{} point{} passed the filter; a surface needs at least four "
                                 "that do not lie in one plane",
                                 num_points, num_points == 1 ? "" : "s"));
}

InputError all_in_one_plane(std::size_t num_points)
{
    return InputError(fmt::format("the {} points that passed the filter all lie in one plane; a "
                                  "surface needs at least four that do not",
                                  num_points));
}

std::logic_error two_at_one_place()
{
    return std::logic_error("two points to triangulate lie at one place");
}

} // namespace vcarve
