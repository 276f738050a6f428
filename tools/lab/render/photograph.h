#pragma once

#include "picture/picture.h"
#include "render/photo_scene.h"

#include <Eigen/Core>

#include <cstdint>

namespace vcarve::render {

/// Renders parts with a texture of solid noise, in ambient light and light from one side; four
/// samples per pixel.
Picture photograph(const Parts& parts, const Pinhole& view);

/// Applies blur and noise of a sensor. Noise depends on the seed only.
Picture grainy(const Picture& picture, const Grain& grain, std::uint32_t seed);

/// Smooth noise in space between 0 and 1: a sum of lattices whose spacings halve from `coarsest`.
/// All have the same amplitude, so there is detail at every distance. Reproducible for a seed.
struct SolidNoise {
    double coarsest = 1.0; ///< spacing of the coarsest lattice
    int lattices = 8;
    std::uint32_t seed = 0;

    double at(const Eigen::Vector3d& place) const;
};

} // namespace vcarve::render
