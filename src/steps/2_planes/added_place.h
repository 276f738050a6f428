#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// A place for a point that a scene shall get. It has one point beside it at least.
struct AddedPlace {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double step = 0.0;                      ///< how far such places stand apart
    std::uint64_t id = kNoPointId;          ///< of the point
    std::vector<std::uint32_t> beside = {}; ///< the model's points next to it, the nearest first
    std::vector<std::uint32_t> track = {};  ///< the views that can see it, ascending; two at least
};

/// What rounding may make of equal lengths, as a share of them: points in rows and columns are at
/// many equal distances, and it shall not matter where they lie.
inline constexpr double kRounding = 1e-6;

/// A point and how far it is.
using Near = std::pair<double, std::uint32_t>;

/// Of some points the nearest two and those as near, up to the slack; the nearest first.
std::vector<std::uint32_t> nearest_two(std::vector<Near> points, double slack);

/// The views that saw any of some points and show a place, ascending.
std::vector<std::uint32_t> views_showing(const Scene& scene, std::span<const std::uint32_t> points,
                                         const Eigen::Vector3d& place);

} // namespace vcarve
