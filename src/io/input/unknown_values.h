#pragma once

#include "vcarve/scene.h"

#include <string>
#include <vector>

namespace vcarve {

/// Takes for unknown what exporters write where they know nothing: errors that are zero at every
/// point, which become -1, and colours that are all black (see has_colors). Returns what the user
/// should know, in sentences. Cost: O(points).
std::vector<std::string> forget_unknown_values(Scene& scene);

} // namespace vcarve
