#pragma once

#include "picture/picture.h"
#include "render/photo_scene.h"

#include <cstdint>

namespace vcarve::render {

/// A picture of parts with a texture of solid noise under even light and some from one side; four
/// samples a pixel.
Picture photograph(const Parts& parts, const Pinhole& view);

/// The picture as a sensor gives it; its noise is the same for the same seed.
Picture grainy(const Picture& picture, const Grain& grain, std::uint32_t seed);

} // namespace vcarve::render
