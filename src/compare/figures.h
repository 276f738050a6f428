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

/// Which way a figure improves.
enum class Better { neither, lower, higher };

/// A figure that meshes are judged by, declared once: the table, the JSON text, what stands below
/// the table and the bounds that the fixtures are held to all come from this.
struct Figure {
    using Value = std::variant<std::monostate, std::int64_t, double>; ///< first: not known

    std::string place; ///< in a mesh's entry of the JSON text, a JSON pointer
    std::string title; ///< of its row in the table, with the unit; empty where it has none
    Better better = Better::neither;
    std::function<Value(const Comparison&)> value;
    std::string format = "{}";      ///< of the number in the table
    double scale = 1.0;             ///< what the table multiplies a real number by
    const char* when_unknown = "-"; ///< in the table
    std::string meaning = {};       ///< one line; empty where the title or an earlier line says it

    /// The figure as a real number; nothing where it is not known.
    std::optional<double> number(const Comparison& comparison) const;
    /// The figure as the table has it.
    std::string shown(const Comparison& comparison) const;
};

/// All figures, from the top of the table to its bottom: of the surface itself, of how it fits the
/// views, of how near it is to the truth where the reference has one, and where a column has them,
/// of the run that made it.
std::vector<Figure> figures(const Reference& reference, std::span<const Comparison> comparisons);

/// Whether some column says what its mesh took to make.
bool has_costs(std::span<const Comparison> comparisons);

/// What the figures are measured against and what each of them means, a line each.
std::vector<std::string> definitions(const Reference& reference,
                                     const std::vector<Figure>& figures);

} // namespace vcarve
