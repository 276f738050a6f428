#pragma once

#include "base/progress.h"
#include "compare/reference.h"

namespace vcarve {

/// Makes the closed surface of the reference's model, as `colmap-vcarve --closed` does, and notes
/// which of the reference's rays meet it, as the stage "closed". `model` is what the reference was
/// made from. Where no surface can be made of it, a note says why and the reference stays as it is;
/// so it does where there are no rays. Cost: that of reconstruct().
void add_closed_surface(Reference& reference, Scene model, Log& log);

} // namespace vcarve
