#include "model/scene_points.h"

#include <numeric>
#include <vector>

namespace vcarve {

Scene PartsOfScene::next(std::size_t most, const Progress& progress)
{
    const std::size_t count = std::min(most, scene_.num_points() - first_);
    std::vector<std::size_t> points(count);
    std::iota(points.begin(), points.end(), first_);
    first_ += count;
    progress.report(1.0);
    return select_points(scene_, points, [&](std::size_t i) { return scene_.tracks[points[i]]; });
}

} // namespace vcarve
