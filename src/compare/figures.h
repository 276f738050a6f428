#pragma once

#include "compare/compare.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace vcarve {

/// The direction in which a figure improves.
enum class Better { neither, lower, higher };

/// A figure of a mesh, declared once. The table, its legend, the JSON text and the limits of the
/// fixtures are made from it.
struct Figure {
    using Value = std::variant<std::monostate, std::int64_t, double>; ///< monostate: unknown

    std::string place; ///< JSON pointer in the mesh's entry of the JSON text
    std::string title; ///< of its table row, with the unit; empty: no row
    Better better = Better::neither;
    std::function<Value(const Comparison&)> value;
    std::string format = "{}";      ///< of numbers in the table
    double scale = 1.0;             ///< factor for numbers in the table
    const char* when_unknown = "-"; ///< in the table, if unknown
    std::string meaning = {};       ///< one line of the legend; empty: no line

    /// The figure as a real number; nothing if unknown.
    std::optional<double> number(const Comparison& comparison) const;
    /// The text of the figure in the table.
    std::string shown(const Comparison& comparison) const;
};

/// Returns all figures in the order of the table: size, agreement with the views, agreement with
/// the truth (if the reference has one), and costs of the run (if has_costs()).
std::vector<Figure> figures(const Reference& reference, std::span<const Comparison> comparisons);

/// Whether a mesh has costs or failed.
bool has_costs(std::span<const Comparison> comparisons);

/// The lines of the legend: the reference, and the meaning of each figure.
std::vector<std::string> definitions(const Reference& reference,
                                     const std::vector<Figure>& figures);

} // namespace vcarve
