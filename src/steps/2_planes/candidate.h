#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How far a candidate stands off its plane at most, in steps: among points in one plane rounding
/// would tell which cells there are.
inline constexpr double kOffPlane = 1e-3;

/// A place where a point may be added, as a generator proposes it.
struct Candidate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    PointKind kind = PointKind::crease;
    double step = 0.0;                         ///< how far apart such points stand
    std::array<std::uint32_t, 2> regions = {}; ///< whose it is: two that meet, or one twice
    bool stands_out = false; ///< as the edge of a box does, before either of the regions' planes
    /// Pieces of the surface that there would be.
    std::vector<std::array<Eigen::Vector3d, 3>> surface = {};
};

} // namespace vcarve
