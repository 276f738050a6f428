#include "compare/comparison_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

namespace vcarve {
namespace {

constexpr int kSchema = 2; ///< changes with the keys

using Json = nlohmann::ordered_json;

/// The cell of a mesh. The first row of a failed mesh has the reason.
std::string shown(const Figure& figure, const Comparison& comparison, bool is_first)
{
    if (comparison.failure.empty()) return figure.shown(comparison);
    return is_first ? comparison.failure : "-";
}

std::string table(std::span<const Comparison> comparisons, const std::vector<TableRow>& rows)
{
    // The cells; the first row is the head.
    std::vector<std::vector<std::string>> cells(rows.size() + 1);
    cells[0].emplace_back("");
    for (const Comparison& comparison : comparisons) {
        cells[0].push_back(comparison.name);
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
        cells[row + 1].push_back(rows[row].title);
        std::ranges::copy(rows[row].cells, std::back_inserter(cells[row + 1]));
    }
    std::vector<std::size_t> widths(cells[0].size(), 3);
    for (const auto& line : cells) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            widths[i] = std::max(widths[i], line[i].size());
        }
    }
    // Align titles to the left, figures to the right.
    std::string text;
    for (std::size_t row = 0; row < cells.size(); ++row) {
        text += fmt::format("| {:<{}} |", cells[row][0], widths[0]);
        for (std::size_t i = 1; i < widths.size(); ++i) {
            text += fmt::format(" {:>{}} |", cells[row][i], widths[i]);
        }
        text += '\n';
        if (row > 0) continue;
        text += fmt::format("|{:-<{}}|", "", widths[0] + 2);
        for (std::size_t i = 1; i < widths.size(); ++i) {
            text += fmt::format("{:->{}}:|", "", widths[i] + 1);
        }
        text += '\n';
    }
    return text;
}

void put(Json& mesh, const std::string& place, std::monostate /*unknown*/)
{
    mesh[Json::json_pointer(place)] = nullptr;
}

template <typename Number>
void put(Json& mesh, const std::string& place, Number number)
{
    mesh[Json::json_pointer(place)] = number;
}

Json mesh_json(const Comparison& comparison, const std::vector<Figure>& figures)
{
    if (!comparison.failure.empty()) {
        return {{"name", comparison.name}, {"failure", comparison.failure}};
    }
    Json mesh = {{"name", comparison.name}};
    for (const Figure& figure : figures) {
        const bool is_of_truth = figure.place.starts_with("/truth/");
        const bool is_of_run = figure.place.starts_with("/cost/");
        if ((is_of_truth && !comparison.truth) || (is_of_run && !comparison.cost)) continue;
        std::visit([&](auto number) { put(mesh, figure.place, number); }, figure.value(comparison));
    }
    return mesh;
}

} // namespace

nlohmann::ordered_json comparison_record(std::span<const Comparison> comparisons,
                                         const Reference& reference)
{
    const std::vector<Figure> judged_by = figures(reference, comparisons);
    Json report;
    report["schema"] = kSchema;
    report["definitions"] = definitions(reference, judged_by);
    report["options"] = {{"samples", reference.options.samples},
                         {"seed", reference.options.seed},
                         {"spacings", reference.options.spacings}};
    report["model"] = {{"points", reference.scene.num_points()},
                       {"views", reference.scene.views.size()},
                       {"rays", reference.scene.num_rays()},
                       {"view_rays", reference.rays.size()},
                       {"median_spacing", reference.median_spacing}};
    report["truth"] = nullptr;
    if (reference.truth) {
        report["truth"] = {{"samples", reference.truth->samples.size()},
                           {"image_samples", reference.truth->image_samples()},
                           {"seen_share", reference.truth->seen_share},
                           {"diagonal", reference.truth->diagonal}};
    }
    report["meshes"] = Json::array();
    for (const Comparison& comparison : comparisons) {
        report["meshes"].push_back(mesh_json(comparison, judged_by));
    }
    return report;
}

std::string comparison_json(std::span<const Comparison> comparisons, const Reference& reference)
{
    // File names may be any bytes: replace invalid UTF-8.
    return comparison_record(comparisons, reference)
               .dump(2, ' ', false, Json::error_handler_t::replace) +
           '\n';
}

std::vector<TableRow> table_rows(std::span<const Comparison> comparisons,
                                 const Reference& reference)
{
    std::vector<TableRow> rows;
    for (const Figure& figure : figures(reference, comparisons)) {
        if (figure.title.empty()) continue;
        TableRow row{figure.title, figure.place, figure.better, {}};
        for (const Comparison& comparison : comparisons) {
            row.cells.push_back(shown(figure, comparison, rows.empty()));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string comparison_table(std::span<const Comparison> comparisons, const Reference& reference)
{
    const std::vector<Figure> judged_by = figures(reference, comparisons);
    std::string text = table(comparisons, table_rows(comparisons, reference));
    text += '\n';
    for (const std::string& line : definitions(reference, judged_by)) {
        text += line + '\n';
    }
    return text;
}

} // namespace vcarve
