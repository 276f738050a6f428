#include "steps/1_points/looked_at_ball.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace vcarve {

namespace {

/// Where the sights of some points end in the mean.
Eigen::Vector3d mean_end(const Scene& scene, std::span<const std::uint32_t> points)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double num_sights = 0.0;
    for (const std::uint32_t point : points) {
        const auto sights = static_cast<double>(scene.tracks[point].size());
        sum += sights * scene.positions[point];
        num_sights += sights;
    }
    return sum / num_sights;
}

} // namespace

Ball looked_at_ball(const Scene& scene)
{
    constexpr double kHeld = 0.94;
    constexpr int kRounds = 4;
    Ball ball;
    if (scene.num_sights() == 0) return ball;
    const double most = kHeld * static_cast<double>(scene.num_sights());
    std::vector<std::uint32_t> order(scene.num_points());
    std::iota(order.begin(), order.end(), 0U);
    std::size_t num_held = order.size();
    for (int round = 0; round < kRounds; ++round) {
        ball.center = mean_end(scene, std::span(order).first(num_held));
        const auto distance_sq = [&](std::uint32_t point) {
            return (scene.positions[point] - ball.center).squaredNorm();
        };
        std::ranges::sort(order, {}, distance_sq);
        double passed = 0.0;
        for (num_held = 0; passed < most; ++num_held) {
            passed += static_cast<double>(scene.tracks[order[num_held]].size());
        }
        ball.radius = std::sqrt(distance_sq(order[num_held - 1]));
    }
    return ball;
}

} // namespace vcarve
