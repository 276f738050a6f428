#include "model/seen_places.h"

#include "model/region_of_interest.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace vcarve {

std::vector<std::size_t> seen_places(const Scene& scene)
{
    constexpr std::size_t kMostPoints = 100'000;
    constexpr double kCubes = 32.0;
    const Ball ball = region_of_interest(scene);
    const double edge = ball.radius > 0.0 ? 2.0 * ball.radius / kCubes : 1.0;
    const std::size_t count = std::min(scene.num_points(), kMostPoints);
    std::vector<std::vector<std::uint32_t>> cubes(scene.views.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t point = i * scene.num_points() / count;
        const Eigen::Vector3d way = scene.positions[point] - ball.center;
        if (!(way.norm() <= ball.radius)) continue; // nor if it is no number
        const Eigen::Array3d steps = (way.array() + ball.radius) / edge;
        const Eigen::Array3d cube = steps.floor().min(kCubes - 1.0);
        const auto number =
            static_cast<std::uint32_t>((cube[0] * kCubes + cube[1]) * kCubes + cube[2]);
        for (const std::uint32_t view : scene.tracks[point]) {
            cubes[view].push_back(number);
        }
    }
    std::vector<std::size_t> places;
    std::ranges::transform(cubes, std::back_inserter(places), [](std::vector<std::uint32_t>& of) {
        std::ranges::sort(of);
        return static_cast<std::size_t>(std::unique(of.begin(), of.end()) - of.begin());
    });
    return places;
}

} // namespace vcarve
