#include "points/middle_box.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace vcarve {

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

Eigen::AlignedBox3d looked_at_box(const Scene& scene)
{
    constexpr double kTail = 0.02;
    Eigen::AlignedBox3d box;
    if (scene.num_sights() == 0) return box;
    const auto left_out =
        static_cast<std::uint64_t>(kTail * static_cast<double>(scene.num_sights()));
    std::vector<std::uint32_t> order(scene.num_points());
    std::iota(order.begin(), order.end(), 0U);
    // The coordinate of the point where more than `left_out` sights are passed.
    const auto end_of = [&](int axis, auto first, auto last) {
        std::uint64_t passed = scene.tracks[*first].size();
        while (passed <= left_out && std::next(first) != last) {
            passed += scene.tracks[*++first].size();
        }
        return scene.positions[*first][axis];
    };
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return scene.positions[i][axis]; });
        box.min()[axis] = end_of(axis, order.begin(), order.end());
        box.max()[axis] = end_of(axis, order.rbegin(), order.rend());
    }
    return box;
}

} // namespace vcarve
