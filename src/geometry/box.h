#pragma once

#include <Eigen/Core>

namespace vcarve {

/// A box along the axes.
struct Box {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
};

/// How far apart two boxes are; 0 where they touch.
inline double distance_between(const Box& a, const Box& b)
{
    const Eigen::Vector3d gap =
        (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Eigen::Vector3d::Zero());
    return gap.norm();
}

} // namespace vcarve
