#pragma once

#include "compare/compare.h"
#include "compare/figures.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A row of the table: one figure of all meshes.
struct TableRow {
    std::string title;
    std::string place; ///< see Figure::place
    Better better = Better::neither;
    std::vector<std::string> cells; ///< one per mesh; the first row has the reason of failures
};

/// Returns the rows of the table in order, without its head.
std::vector<TableRow> table_rows(std::span<const Comparison> comparisons,
                                 const Reference& reference);

/// Returns the figures as a Markdown table with a row per figure and a column per mesh, followed by
/// a legend. Ends with a newline.
std::string comparison_table(std::span<const Comparison> comparisons, const Reference& reference);

/// Returns the same as JSON, and as JSON text: "definitions", "options", "model", "truth" (null if
/// missing) and "meshes". Each mesh has "name", "size", "views" and, if known, "truth" and "cost";
/// a failed mesh has "name" and "failure".
nlohmann::ordered_json comparison_record(std::span<const Comparison> comparisons,
                                         const Reference& reference);
std::string comparison_json(std::span<const Comparison> comparisons, const Reference& reference);

} // namespace vcarve
