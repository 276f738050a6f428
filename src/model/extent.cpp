#include "model/extent.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "vcarve/io.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// The squared distance of a point, and the number of its rays.
struct Ends {
    double distance_sq;
    double num_rays;
};

/// The mean end of the rays that end within a distance of `around`.
Vector3d mean_end(const Scene& scene, const Vector3d& around, double most_sq)
{
    const Vector4d sum =
        parallel_sum(scene.num_points(), Vector4d(Vector4d::Zero()), [&](std::size_t point) {
            const auto rays = static_cast<double>(scene.tracks[point].size());
            const Vector3d& place = scene.positions[point];
            const bool counts = rays > 0.0 && (place - around).squaredNorm() <= most_sq;
            return counts ? Vector4d(rays * Vector4d(place.x(), place.y(), place.z(), 1.0))
                          : Vector4d(Vector4d::Zero());
        });
    return sum.head<3>() / sum[3];
}

/// The square of the least distance within which `num_rays` rays end. Reorders `ends`.
/// Cost: O(points).
double distance_sq_of(double num_rays, std::vector<Ends>& ends)
{
    auto first = ends.begin();
    auto last = ends.end();
    while (last - first > 1) {
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [](const Ends& a, const Ends& b) {
            return a.distance_sq < b.distance_sq;
        });
        double nearer = 0.0;
        for (auto end = first; end != middle; ++end) {
            nearer += end->num_rays;
        }
        if (nearer >= num_rays) {
            last = middle;
        } else {
            first = middle;
            num_rays -= nearer;
        }
    }
    return first->distance_sq;
}

/// Floats have seven digits. So they represent coordinates up to kNear times the size of a scene to
/// within 1e-6 of its size.
constexpr double kNear = 10.0;

/// Rounds to a multiple of the least power of ten that is not below `size`.
double round_to_size(double coordinate, double size)
{
    const double power = std::ceil(std::log10(size));
    // Positive powers of ten are doubles, negative ones are not.
    const double ten = std::pow(10.0, std::abs(power));
    return power < 0.0 ? std::round(coordinate * ten) / ten : std::round(coordinate / ten) * ten;
}

} // namespace

Eigen::AlignedBox3d middle_box(const std::vector<Eigen::Vector3d>& positions, double tail)
{
    Eigen::AlignedBox3d box;
    if (positions.empty()) return box;
    std::vector<double> values(positions.size());
    const auto low = static_cast<std::ptrdiff_t>(tail * static_cast<double>(values.size() - 1));
    const auto high = static_cast<std::ptrdiff_t>(values.size()) - 1 - low;
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(positions, values.begin(), [&](const auto& p) { return p[axis]; });
        std::nth_element(values.begin(), values.begin() + low, values.end());
        box.min()[axis] = values[static_cast<std::size_t>(low)];
        std::nth_element(values.begin(), values.begin() + high, values.end());
        box.max()[axis] = values[static_cast<std::size_t>(high)];
    }
    return box;
}

Ball region_of_interest(const Scene& scene)
{
    constexpr double kHeld = 0.94;
    constexpr int kRounds = 4;
    Ball ball;
    if (scene.num_rays() == 0) return ball;
    const double most = kHeld * static_cast<double>(scene.num_rays());
    std::vector<Ends> ends(scene.num_points());
    double held_sq = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        ball.center = mean_end(scene, ball.center, held_sq);
        parallel_for(ends.size(), [&](std::size_t point) {
            ends[point] = {(scene.positions[point] - ball.center).squaredNorm(),
                           static_cast<double>(scene.tracks[point].size())};
        });
        held_sq = distance_sq_of(most, ends);
    }
    ball.radius = std::sqrt(held_sq);
    return ball;
}

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
        if (!(way.norm() <= ball.radius)) continue; // also skips NaN
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

Eigen::Vector3d round_offset(const Scene& model)
{
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(model.positions.size());
    std::ranges::copy_if(model.positions, std::back_inserter(positions),
                         [](const Eigen::Vector3d& position) { return position.allFinite(); });
    const double size = positions.empty() ? 0.0 : middle_box(positions).diagonal().norm();
    if (!(size > 0.0)) return offset;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values(positions.size());
        std::ranges::transform(positions, values.begin(), [&](const auto& p) { return p[axis]; });
        const double middle = median_in_place(values) + model.offset[axis];
        if (std::abs(middle) > kNear * size) offset[axis] = round_to_size(middle, size);
    }
    return offset;
}

} // namespace vcarve
