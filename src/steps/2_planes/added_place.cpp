#include "steps/2_planes/added_place.h"

#include "base/sort_unique.h"
#include "model/camera.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vcarve {

std::vector<std::uint32_t> nearest_two(std::vector<Near> points, double slack)
{
    constexpr std::size_t kCount = 2;
    const auto last = points.begin() + static_cast<std::ptrdiff_t>(std::min(kCount, points.size()));
    std::ranges::nth_element(points, last - 1);
    const double most = (last - 1)->first + slack;
    std::erase_if(points, [&](const Near& point) { return point.first > most; });
    std::ranges::sort(points);
    std::vector<std::uint32_t> nearest(points.size());
    std::ranges::transform(points, nearest.begin(), &Near::second);
    return nearest;
}

std::vector<std::uint32_t> views_showing(const Scene& scene, std::span<const std::uint32_t> points,
                                         const Eigen::Vector3d& place)
{
    std::vector<std::uint32_t> views;
    for (const std::uint32_t point : points) {
        std::ranges::copy(scene.tracks[point], std::back_inserter(views));
    }
    sort_unique(views);
    std::erase_if(views, [&](std::uint32_t index) {
        const View& view = scene.views[index];
        return !view_shows(view, scene.cameras[view.camera], place);
    });
    return views;
}

} // namespace vcarve
