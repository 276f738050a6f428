#pragma once

#include "compare/compare.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A row of the table: what it is called, and the figure as the reader sees it.
struct Row {
    std::string title;
    std::function<std::string(const Comparison&)> figure;
};

/// Whether some column says what its mesh took to make.
bool has_costs(std::span<const Comparison> comparisons);

/// The rows of the table, from top to bottom. Each asks for a column that has a mesh.
std::vector<Row> report_rows(std::span<const Comparison> comparisons, bool with_truth);

} // namespace vcarve
