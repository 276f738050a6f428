#include "report/report.h"

#include "report/definitions.h"
#include "report/report_rows.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace vcarve {
namespace {

using Json = nlohmann::ordered_json;

/// A column without a mesh says why in its first row.
std::string figure_of(const Row& row, const Comparison& comparison, bool is_first)
{
    if (comparison.failure.empty()) return row.figure(comparison);
    return is_first ? comparison.failure : "-";
}

std::string table(std::span<const Comparison> comparisons, const std::vector<Row>& rows)
{
    // The cells, the first row being the head.
    std::vector<std::vector<std::string>> cells(rows.size() + 1);
    cells[0].emplace_back("");
    for (const Comparison& comparison : comparisons) {
        cells[0].push_back(comparison.name);
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
        cells[row + 1].push_back(rows[row].title);
        for (const Comparison& comparison : comparisons) {
            cells[row + 1].push_back(figure_of(rows[row], comparison, row == 0));
        }
    }
    std::vector<std::size_t> widths(cells[0].size(), 3);
    for (const auto& line : cells) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            widths[i] = std::max(widths[i], line[i].size());
        }
    }
    // Titles to the left, figures to the right.
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

Json size_json(const Comparison& comparison)
{
    const MeshCheck& size = comparison.size;
    return {{"vertices", size.vertices},
            {"faces", size.faces},
            {"area", size.area},
            {"components", size.components},
            {"boundary_edges", size.boundary_edges},
            {"nonmanifold_edges", size.nonmanifold_edges},
            {"nonmanifold_vertices", size.nonmanifold_vertices},
            {"orientation_faults", size.orientation_faults},
            {"degenerate_faces", size.degenerate_faces},
            {"unreferenced_vertices", size.unreferenced_vertices},
            {"genus", comparison.genus ? Json(*comparison.genus) : Json(nullptr)}};
}

Json line_json(const TruthFigures& figures, double LineFigures::*member)
{
    return figures.lines ? Json((*figures.lines).*member) : Json(nullptr);
}

Json truth_json(const TruthFigures& figures)
{
    Json agreements = Json::array();
    for (const Agreement& agreement : figures.agreements) {
        agreements.push_back({{"tolerance", agreement.tolerance},
                              {"f", agreement.f_score},
                              {"precision", agreement.precision},
                              {"recall", agreement.recall}});
    }
    return {{"agreement", agreements},
            {"mean_accuracy", figures.mean_accuracy},
            {"mean_completeness", figures.mean_completeness},
            {"blocked", figures.blocked},
            {"seen_right", line_json(figures, &LineFigures::seen_right)},
            {"torn", line_json(figures, &LineFigures::torn)},
            {"open", line_json(figures, &LineFigures::open)}};
}

Json views_json(const EvidenceFigures& evidence)
{
    Json json = {{"hidden_sights", evidence.hidden_sights},
                 {"missed_points", evidence.missed_points},
                 {"unsupported_area", evidence.unsupported_area},
                 {"median_distance", evidence.median_distance},
                 {"seen_boundary_edges", evidence.seen_boundary_edges},
                 {"back_faces_seen", nullptr},
                 {"nothing_seen", nullptr}};
    if (!evidence.rays) return json;
    json["back_faces_seen"] = evidence.rays->back_faces_seen;
    if (evidence.rays->nothing_seen) json["nothing_seen"] = *evidence.rays->nothing_seen;
    return json;
}

Json mesh_json(const Comparison& comparison)
{
    if (!comparison.failure.empty()) {
        return {{"name", comparison.name}, {"failure", comparison.failure}};
    }
    Json mesh = {{"name", comparison.name},
                 {"size", size_json(comparison)},
                 {"views", views_json(comparison.evidence)}};
    if (comparison.truth) mesh["truth"] = truth_json(*comparison.truth);
    if (comparison.cost) {
        mesh["cost"] = {{"seconds", comparison.cost->seconds},
                        {"cpu_seconds", comparison.cost->cpu_seconds},
                        {"peak_memory_bytes", comparison.cost->peak_memory_bytes}};
    }
    return mesh;
}

} // namespace

std::string comparison_json(std::span<const Comparison> comparisons, const Reference& reference)
{
    Json report;
    report["definitions"] = definitions(reference, has_costs(comparisons));
    report["options"] = {{"samples", reference.options.samples},
                         {"seed", reference.options.seed},
                         {"spacings", reference.options.spacings}};
    report["model"] = {{"points", reference.scene.num_points()},
                       {"views", reference.scene.views.size()},
                       {"sights", reference.scene.num_sights()},
                       {"rays", reference.rays.size()},
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
        report["meshes"].push_back(mesh_json(comparison));
    }
    // A file's name may be any bytes; what is not UTF-8 is replaced, not fatal.
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string comparison_table(std::span<const Comparison> comparisons, const Reference& reference)
{
    const std::vector<Row> rows = report_rows(comparisons, reference.truth.has_value());
    std::string text = table(comparisons, rows);
    text += '\n';
    for (const std::string& line : definitions(reference, has_costs(comparisons))) {
        text += line + '\n';
    }
    return text;
}

} // namespace vcarve
