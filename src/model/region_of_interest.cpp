#include "model/region_of_interest.h"

#include "base/parallel.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// How far a point is, and how many sights end there.
struct Ends {
    double distance_sq;
    double num_sights;
};

/// Where the sights end in the mean that end within a distance of a place.
Vector3d mean_end(const Scene& scene, const Vector3d& around, double most_sq)
{
    const Vector4d sum =
        parallel_sum(scene.num_points(), Vector4d(Vector4d::Zero()), [&](std::size_t point) {
            const auto sights = static_cast<double>(scene.tracks[point].size());
            const Vector3d& place = scene.positions[point];
            const bool counts = sights > 0.0 && (place - around).squaredNorm() <= most_sq;
            return counts ? Vector4d(sights * Vector4d(place.x(), place.y(), place.z(), 1.0))
                          : Vector4d(Vector4d::Zero());
        });
    return sum.head<3>() / sum[3];
}

/// The square of the least distance within which so many sights end. Changes the order.
/// Cost: O(points).
double distance_sq_of(double num_sights, std::vector<Ends>& ends)
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
            nearer += end->num_sights;
        }
        if (nearer >= num_sights) {
            last = middle;
        } else {
            first = middle;
            num_sights -= nearer;
        }
    }
    return first->distance_sq;
}

} // namespace

Ball region_of_interest(const Scene& scene)
{
    constexpr double kHeld = 0.94;
    constexpr int kRounds = 4;
    Ball ball;
    if (scene.num_sights() == 0) return ball;
    const double most = kHeld * static_cast<double>(scene.num_sights());
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

} // namespace vcarve
