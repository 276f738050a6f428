#pragma once

#include <Eigen/Core>

#include <limits>

namespace vcarve {

/// No coordinate is larger: of places further out neither an area nor a volume is a finite number.
inline constexpr double kFarthest = 1e100;

/// Whether a position is a place, and neither too far out nor not a number.
inline bool is_place(const Eigen::Vector3d& position)
{
    return (position.array().abs() <= kFarthest).all();
}

/// The position where it is a place, else one that is not a number, as which it is dropped later.
inline Eigen::Vector3d place_or_none(const Eigen::Vector3d& position)
{
    if (is_place(position)) return position;
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

} // namespace vcarve
