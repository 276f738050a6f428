#pragma once

#include "compare/compare.h"
#include "compare/figures.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A figure of every mesh, as the table has it.
struct TableRow {
    std::string title;
    std::string place; ///< see Figure::place
    Better better = Better::neither;
    std::vector<std::string> cells; ///< one a mesh; of one that failed, in the first row why
};

/// The rows of the table from its top to its bottom, without its head.
std::vector<TableRow> table_rows(std::span<const Comparison> comparisons,
                                 const Reference& reference);

/// The figures as a Markdown table, a row a figure and a column a mesh, followed by what the
/// figures mean. Ends with a newline.
std::string comparison_table(std::span<const Comparison> comparisons, const Reference& reference);

/// The same as JSON, and as its text: "definitions", "options", "model", "truth" (null where there
/// is none) and "meshes", each with "name", "size", "views" and, where known, "truth" and "cost";
/// where there is no mesh, "name" and "failure".
nlohmann::ordered_json comparison_record(std::span<const Comparison> comparisons,
                                         const Reference& reference);
std::string comparison_json(std::span<const Comparison> comparisons, const Reference& reference);

} // namespace vcarve
