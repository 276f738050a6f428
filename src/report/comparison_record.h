#pragma once

#include "compare/compare.h"

#include <nlohmann/json.hpp>

#include <span>

namespace vcarve {

/// What comparison_json() writes, to be read further.
nlohmann::ordered_json comparison_record(std::span<const Comparison> comparisons,
                                         const Reference& reference);

} // namespace vcarve
