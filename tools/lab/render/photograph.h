#pragma once

#include "picture/picture.h"
#include "render/photo_scene.h"

#include <Eigen/Core>

#include <cstdint>

namespace vcarve::render {

/// A picture of parts with a texture of solid noise under even light and some from one side; four
/// samples a pixel.
Picture photograph(const Parts& parts, const Pinhole& view);

/// The picture as a sensor gives it; its noise is the same for the same seed.
Picture grainy(const Picture& picture, const Grain& grain, std::uint32_t seed);

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
