#include "model/scene_parts.h"

#include "model/scene_points.h"

#include <ranges>

namespace vcarve {

Scene PartsOfScene::next(std::size_t most, const Progress& progress)
{
    const std::size_t count = std::min(most, scene_.num_points() - first_);
    const auto points = std::views::iota(first_, first_ + count);
    first_ += count;
    progress.tell(1.0);
    return select_points(scene_, points, [&](std::size_t i) { return scene_.tracks[points[i]]; });
}

} // namespace vcarve
