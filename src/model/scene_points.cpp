#include "model/scene_points.h"

#include <numeric>
#include <vector>

namespace vcarve {

void PointSample::add(const Scene& part)
{
    std::size_t number = points;
    append_points(part, scene, [&](std::size_t) { return number++ % one_in == 0; });
    points += part.num_points();
    rays += part.num_rays();
    while (scene.num_points() > most) {
        one_in *= 2;
        std::vector<std::size_t> even((scene.num_points() + 1) / 2);
        std::ranges::generate(even, [at = std::size_t{0}]() mutable { return 2 * at++; });
        const auto track_of = [&](std::size_t i) { return scene.tracks[even[i]]; };
        keep_points(scene, even, make_tracks(even.size(), track_of));
    }
}

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
