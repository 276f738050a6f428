#include "compare/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Json = nlohmann::ordered_json;

/// A row of the table: what it is called, and the figure as the reader sees it.
struct Row {
    std::string title;
    std::function<std::string(const Comparison&)> figure;
};

std::string share(double value)
{
    return fmt::format("{:.4f}", value);
}

Row count_row(const char* title, std::int64_t MeshCheck::*member)
{
    return {title, [member](const Comparison& c) { return fmt::format("{}", c.size.*member); }};
}

std::vector<Row> size_rows()
{
    return {
        count_row("vertices", &MeshCheck::vertices),
        count_row("faces", &MeshCheck::faces),
        {"area", [](const Comparison& c) { return fmt::format("{:.5g}", c.size.area); }},
        count_row("components", &MeshCheck::components),
        count_row("boundary edges", &MeshCheck::boundary_edges),
        count_row("non-manifold edges", &MeshCheck::nonmanifold_edges),
        count_row("non-manifold vertices", &MeshCheck::nonmanifold_vertices),
        count_row("orientation faults", &MeshCheck::orientation_faults),
        count_row("degenerate faces", &MeshCheck::degenerate_faces),
        count_row("unreferenced vertices", &MeshCheck::unreferenced_vertices),
        {"genus",
         [](const Comparison& c) { return c.genus ? fmt::format("{}", *c.genus) : "open"; }},
    };
}

Row evidence_row(const char* title, double EvidenceFigures::*member)
{
    return {title, [member](const Comparison& c) { return share(c.evidence.*member); }};
}

std::vector<Row> evidence_rows()
{
    return {
        evidence_row("hidden sights", &EvidenceFigures::hidden_sights),
        evidence_row("missed points", &EvidenceFigures::missed_points),
        evidence_row("unsupported area", &EvidenceFigures::unsupported_area),
        evidence_row("median distance [spacings]", &EvidenceFigures::median_distance),
    };
}

Row truth_row(std::string title, std::function<double(const TruthFigures&)> figure)
{
    return {std::move(title), [figure = std::move(figure)](const Comparison& c) {
                return c.truth ? share(figure(*c.truth)) : "-";
            }};
}

Row line_row(const char* title, double LineFigures::*member)
{
    return {title, [member](const Comparison& c) {
                return c.truth && c.truth->lines ? share((*c.truth->lines).*member) : "-";
            }};
}

std::vector<Row> truth_rows()
{
    std::vector<Row> rows;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        const std::string at = fmt::format(" {} %", 100.0 * kTolerances[i]);
        rows.push_back(truth_row("F" + at, [i](const auto& t) { return t.agreements[i].f_score; }));
        rows.push_back(
            truth_row("precision" + at, [i](const auto& t) { return t.agreements[i].precision; }));
        rows.push_back(
            truth_row("recall" + at, [i](const auto& t) { return t.agreements[i].recall; }));
    }
    rows.push_back(
        truth_row("mean accuracy [%]", [](const auto& t) { return 100.0 * t.mean_accuracy; }));
    rows.push_back(truth_row("mean completeness [%]",
                             [](const auto& t) { return 100.0 * t.mean_completeness; }));
    rows.push_back(truth_row("blocked", [](const auto& t) { return t.blocked; }));
    rows.push_back(line_row("seen right", &LineFigures::seen_right));
    rows.push_back(line_row("torn", &LineFigures::torn));
    rows.push_back(line_row("open", &LineFigures::open));
    return rows;
}

Row cost_row(const char* title, std::function<std::string(const RunCost&)> figure)
{
    return {title, [figure = std::move(figure)](const Comparison& c) {
                return c.cost ? figure(*c.cost) : "-";
            }};
}

std::vector<Row> cost_rows()
{
    return {
        cost_row("seconds", [](const auto& cost) { return fmt::format("{:.2f}", cost.seconds); }),
        cost_row("CPU seconds",
                 [](const auto& cost) { return fmt::format("{:.2f}", cost.cpu_seconds); }),
        cost_row("peak memory [MB]",
                 [](const auto& cost) {
                     return fmt::format("{:.1f}",
                                        static_cast<double>(cost.peak_memory_bytes) / 1e6);
                 }),
    };
}

bool has_costs(std::span<const Comparison> comparisons)
{
    return std::ranges::any_of(comparisons,
                               [](const Comparison& c) { return c.cost || !c.failure.empty(); });
}

constexpr const char* kCostDefinition = "seconds, CPU seconds (all threads), peak memory: of the "
                                        "whole program that made the mesh, from "
                                        "its start to its end, on this machine.";

/// A column without a mesh says why in its first row.
std::string figure_of(const Row& row, const Comparison& comparison, bool is_first)
{
    if (comparison.failure.empty()) return row.figure(comparison);
    return is_first ? comparison.failure : "-";
}

std::string line_definition(const Truth& truth)
{
    return fmt::format(
        "seen right, torn, open: shares of lines from a view on through a sample of the truth that "
        "it sees within its image (one a sample, at random; {} of {} samples have one): first meet "
        "the mesh from its front, at most 0.5 % of the diagonal before or behind the sample; first "
        "meet it from its back; do not meet it.",
        truth.image_samples(), truth.samples.size());
}

/// What the figures mean, a line each, written where the user reads them.
std::vector<std::string> definitions(const Yardstick& yardstick)
{
    const double k = yardstick.options.spacings;
    std::vector<std::string> lines = {
        fmt::format("Measured against {} points with at least 2 views and {} views; spacing of a "
                    "point = distance to its 6th nearest point.",
                    yardstick.scene.num_points(), yardstick.scene.views.size()),
        fmt::format(
            "hidden sights: share of lines from a point to a view that saw it which meet the "
            "mesh farther than {} spacings from the point.",
            k),
        fmt::format("missed points: share of points farther than {} spacings from the mesh.", k),
        "unsupported area: share of the mesh's area that no view sees from its front (within the "
        "image, nothing of the mesh between).",
        "genus: handles of a closed manifold surface; open where it is not one.",
    };
    if (!yardstick.truth) return lines;
    lines.push_back(fmt::format("truth: {} samples by area of what at least 3 views see (nothing "
                                "of the truth between, under 80 degrees from the normal, wherever "
                                "its image ends; {:.1f} % of its area), seed {}; "
                                "diagonal = of their box = {:.6g}.",
                                yardstick.truth->samples.size(),
                                100.0 * yardstick.truth->seen_share, yardstick.options.seed,
                                yardstick.truth->diagonal));
    lines.push_back(fmt::format(
        "precision: share of {} samples by area of the whole mesh within that part of the diagonal "
        "of the truth; recall: of the truth's samples, of the mesh; F: harmonic mean.",
        yardstick.options.samples));
    lines.emplace_back(
        "accuracy, completeness: mean distance of the mesh's samples to the truth and back, "
        "in % of the diagonal.");
    lines.emplace_back(
        "blocked: share of the truth's samples whose line to a view that sees them (one a "
        "sample, at random) meets the mesh farther than 1 % of the diagonal from the sample.");
    lines.push_back(line_definition(*yardstick.truth));
    return lines;
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

Json mesh_json(const Comparison& comparison)
{
    if (!comparison.failure.empty()) {
        return {{"name", comparison.name}, {"failure", comparison.failure}};
    }
    const EvidenceFigures& evidence = comparison.evidence;
    Json mesh = {{"name", comparison.name},
                 {"size", size_json(comparison)},
                 {"views",
                  {{"hidden_sights", evidence.hidden_sights},
                   {"missed_points", evidence.missed_points},
                   {"unsupported_area", evidence.unsupported_area},
                   {"median_distance", evidence.median_distance}}}};
    if (comparison.truth) mesh["truth"] = truth_json(*comparison.truth);
    if (comparison.cost) {
        mesh["cost"] = {{"seconds", comparison.cost->seconds},
                        {"cpu_seconds", comparison.cost->cpu_seconds},
                        {"peak_memory_bytes", comparison.cost->peak_memory_bytes}};
    }
    return mesh;
}

} // namespace

std::string comparison_json(std::span<const Comparison> comparisons, const Yardstick& yardstick)
{
    Json report;
    report["definitions"] = definitions(yardstick);
    if (has_costs(comparisons)) report["definitions"].push_back(kCostDefinition);
    report["options"] = {{"samples", yardstick.options.samples},
                         {"seed", yardstick.options.seed},
                         {"spacings", yardstick.options.spacings}};
    report["model"] = {{"points", yardstick.scene.num_points()},
                       {"views", yardstick.scene.views.size()},
                       {"sights", yardstick.scene.num_sights()},
                       {"median_spacing", yardstick.median_spacing}};
    report["truth"] = nullptr;
    if (yardstick.truth) {
        report["truth"] = {{"samples", yardstick.truth->samples.size()},
                           {"image_samples", yardstick.truth->image_samples()},
                           {"seen_share", yardstick.truth->seen_share},
                           {"diagonal", yardstick.truth->diagonal}};
    }
    report["meshes"] = Json::array();
    for (const Comparison& comparison : comparisons) {
        report["meshes"].push_back(mesh_json(comparison));
    }
    // A file's name may be any bytes; what is not UTF-8 is replaced, not fatal.
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string comparison_table(std::span<const Comparison> comparisons, const Yardstick& yardstick)
{
    std::vector<Row> rows = size_rows();
    for (Row& row : evidence_rows()) {
        rows.push_back(std::move(row));
    }
    if (yardstick.truth) {
        for (Row& row : truth_rows()) {
            rows.push_back(std::move(row));
        }
    }
    const bool with_costs = has_costs(comparisons);
    if (with_costs) {
        for (Row& row : cost_rows()) {
            rows.push_back(std::move(row));
        }
    }
    std::string text = table(comparisons, rows);
    text += '\n';
    for (const std::string& line : definitions(yardstick)) {
        text += line + '\n';
    }
    if (with_costs) text += std::string(kCostDefinition) + '\n';
    return text;
}

} // namespace vcarve
