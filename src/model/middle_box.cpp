#include "model/middle_box.h"

#include <algorithm>
#include <cstddef>

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

} // namespace vcarve
