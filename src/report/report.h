#pragma once

#include "compare/compare.h"

#include <span>
#include <string>

namespace vcarve {

/// The figures as a Markdown table, a row a figure and a column a mesh, followed by what the
/// figures mean. Ends with a newline.
std::string comparison_table(std::span<const Comparison> comparisons, const Reference& reference);

/// The same as JSON text: "definitions", "options", "model", "truth" (null where there is none) and
/// "meshes", each with "name", "size", "views" and, where known, "truth" and "cost"; where there is
/// no mesh, "name" and "failure".
std::string comparison_json(std::span<const Comparison> comparisons, const Reference& reference);

} // namespace vcarve
