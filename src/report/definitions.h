#pragma once

#include "compare/reference.h"

#include <string>
#include <vector>

namespace vcarve {

/// What the figures mean, a line each, written where the user reads them.
std::vector<std::string> definitions(const Reference& reference, bool with_costs);

} // namespace vcarve
