#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace vcarve::render {

/// Smooth noise in space between 0 and 1, a sum of lattices from `coarsest` down by halves, all of
/// the same strength, so that it has detail at every distance. The same everywhere for the same
/// seed.
struct SolidNoise {
    double coarsest = 1.0; ///< spacing of the coarsest lattice
    int lattices = 8;
    std::uint32_t seed = 0;

    double at(const Eigen::Vector3d& place) const;
};

} // namespace vcarve::render
