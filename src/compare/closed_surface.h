#pragma once

#include "base/log.h"
#include "compare/yardstick.h"

namespace vcarve {

/// Makes the closed surface of the yardstick's model, as `colmap-vcarve --closed` does, and notes
/// which of the yardstick's rays meet it, as the stage "closed". `model` is what the yardstick was
/// made from. Where no surface can be made of it, a note says why and the yardstick stays as it is;
/// so it does where there are no rays. Cost: that of reconstruct().
void add_closed_surface(Yardstick& yardstick, Scene model, Log& log);

} // namespace vcarve
