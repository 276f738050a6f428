#pragma once

#include <limits>

namespace vcarve {

/// The end of a range that has none.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

} // namespace vcarve
