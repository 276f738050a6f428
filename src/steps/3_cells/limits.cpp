#include "steps/3_cells/limits.h"

#include <fmt/core.h>

namespace vcarve {

void require_four_points(std::size_t num_points, std::string_view losses)
{
    if (num_points >= 4) return;
    throw NoSurface(fmt::format("{} point{} passed the filter; a surface needs at least four "
                                "that do not lie in one plane{}",
                                num_points, num_points == 1 ? "" : "s", losses));
}

NoSurface all_in_one_plane(std::size_t num_points)
{
    return NoSurface(fmt::format("the {} points that passed the filter all lie in one plane; a "
                                 "surface needs at least four that do not",
                                 num_points));
}

InputError too_many_cells(std::size_t most)
{
    return InputError(
        fmt::format("the points have more than {} cells, all that --max-memory allows, "
                    "because many lie on few lines or curves; raise --max-memory",
                    most));
}

std::logic_error duplicate_position_error()
{
    return std::logic_error("two points to triangulate have the same position");
}

} // namespace vcarve
