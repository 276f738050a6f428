#include "io/input/unknown_values.h"

#include "model/colors.h"

#include <algorithm>

namespace vcarve {

std::vector<std::string> forget_unknown_values(Scene& scene)
{
    std::vector<std::string> notes;
    if (scene.num_points() == 0) return notes;
    if (std::ranges::all_of(scene.errors_px, [](double error) { return error == 0.0; })) {
        scene.errors_px.assign(scene.num_points(), -1.0);
        notes.emplace_back("the error of every point is 0, so errors are taken for unknown: no "
                           "point falls to --max-error, and all weigh the same");
    }
    if (!has_colors(scene)) {
        notes.emplace_back("the points have no colours, so the surface gets none; normals show "
                           "its shape");
    }
    return notes;
}

} // namespace vcarve
