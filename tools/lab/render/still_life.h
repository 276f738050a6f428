#pragma once

#include "render/parts.h"

namespace vcarve::render {

/// The scene behind fixtures/scene: things on a floor before a wall.
Parts still_life();

} // namespace vcarve::render
