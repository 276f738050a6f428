#include "base/median.h"
#include "model/middle_box.h"
#include "vcarve/io.h"

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

/// A float has seven digits, so it keeps 1e-6 of a scene's size in coordinates up to so many times
/// that size.
constexpr double kNear = 10.0;

/// A multiple of the power of ten that is as large as the scene, or next above it.
double round_to_size(double coordinate, double size)
{
    const double power = std::ceil(std::log10(size));
    // Positive powers of ten are doubles, negative ones are not.
    const double ten = std::pow(10.0, std::abs(power));
    return power < 0.0 ? std::round(coordinate * ten) / ten : std::round(coordinate / ten) * ten;
}

} // namespace

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
